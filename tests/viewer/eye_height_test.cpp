#include "viewer/eye_height.hpp"

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

/// 50 m over a square of 10 degrees at the equator.
geo::Geoid plateau() {
    const geo::GeoidNodes nodes{.south = 0,
                                .west = 0,
                                .step_lat = 1,
                                .step_lon = 1,
                                .rows = 11,
                                .columns = 11,
                                .undulations = std::vector<double>(121, 50)};
    return *geo::Geoid::from_nodes(nodes, "plateau");
}

TEST(EyeHeight, IsAboveTheScenesGeoidWhereThatIsAndElsewhereAboveEgm96) {
    const geo::Geoid own = plateau();
    const geo::LatLon inside{geo::Degrees{5}, geo::Degrees{5}};
    const geo::LatLon outside{geo::Degrees{42}, geo::Degrees{-105}};
    const EyeHeight heights(&own);
    EXPECT_NEAR(heights.undulation(inside).m, 50, 1e-9);
    const auto egm96 = geo::Geoid::egm96();
    ASSERT_TRUE(egm96) << egm96.error().message;
    EXPECT_EQ(heights.undulation(outside).m, egm96->undulation(outside).m);
    EXPECT_NEAR(heights.undulation(inside).m, 50, 1e-9);
}

TEST(EyeHeight, IsTheEllipsoidsWhereTheScenesAre) {
    EXPECT_EQ(EyeHeight(nullptr).undulation({geo::Degrees{42}, geo::Degrees{-105}}).m, 0);
}

}  // namespace
}  // namespace relevo::viewer
