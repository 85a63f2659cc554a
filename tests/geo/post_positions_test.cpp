#include "geo/post_positions.hpp"

#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/geo/position_difference.hpp"

namespace relevo::geo {
namespace {

TEST(PostPositions, AgreeWithGeographicLib) {
    const std::vector<GridFrame> frames{{FrameKind::geographic, -106, 38, 1.0 / 3600, 1.0 / 3600, 3601, 3601},
                                        {FrameKind::geographic, 179, -16, 1.0 / 1200, 1.0 / 1200, 2401, 1201},
                                        {FrameKind::geographic, -180, 90, 0.25, 0.25, 1441, 721},
                                        {FrameKind::geographic, 0, 0.5, 1e-5, 1e-5, 513, 513},
                                        {FrameKind::geographic, 20, 84, 1.0 / 1200, 1.0 / 3600, 8193, 8193}};
    double worst = 0;
    for (const GridFrame& frame : frames) worst = std::max(worst, worst_difference(frame));
    RecordProperty("worst_nm", std::to_string(worst * 1e9));
    EXPECT_LT(worst, 4e-9);  // what post_positions.hpp says
}

TEST(PostPositions, NormalIsTheDirectionOfHeight) {
    const GridFrame frame{FrameKind::geographic, -180, 90, 1, 1, 361, 181};
    const PostPositions posts(frame);
    for (const int row : {0, 1, 45, 90, 180}) {
        for (const int column : {0, 77, 180, 360}) {
            const glm::dvec3 step = posts.at(column, row, 1000) - posts.at(column, row, 0);
            EXPECT_LT(glm::length(step / 1000.0 - posts.normal(column, row)), 1e-11);
            EXPECT_NEAR(glm::length(posts.normal(column, row)), 1, 1e-15);
        }
    }
}

TEST(PostPositions, APoleIsOnePointAndTheEarthCloses) {
    const GridFrame frame{FrameKind::geographic, -180, 90, 1, 1, 361, 181};
    const PostPositions posts(frame);
    EXPECT_EQ(posts.at(0, 0, 50), posts.at(123, 0, 50));
    EXPECT_EQ(posts.at(0, 60, 50), posts.at(360, 60, 50));
}

}  // namespace
}  // namespace relevo::geo
