// The coarse grid against the geoid itself, at places that its construction did not look at.

#include "lod/undulation_grid.hpp"

#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace relevo::test {
namespace {

using lod::UndulationGrid;

geo::GridFrame frame_of(double west, double north, double step, int columns, int rows) {
    return {geo::FrameKind::geographic, west, north, step, step, columns, rows};
}

/// The pole in the middle.
geo::GridFrame test_polar(geo::FrameKind kind, double step, int side) {
    const double half = 0.5 * (side - 1) * step;
    return {kind, geo::kUpsFalseOrigin - half, geo::kUpsFalseOrigin + half, step, step, side, side};
}

std::shared_ptr<const geo::Geoid> egm96() {
    auto geoid = geo::Geoid::egm96();
    return geoid ? std::make_shared<const geo::Geoid>(*std::move(geoid)) : nullptr;
}

class UndulationGrids : public testing::TestWithParam<geo::GridFrame> {};

TEST_P(UndulationGrids, AgreeWithTheGeoid) {
    const auto geoid = egm96();
    if (!geoid) GTEST_SKIP() << "no geoid";
    const geo::GridFrame& frame = GetParam();
    const UndulationGrid grid(geoid, frame);
    std::mt19937 random(7);
    std::uniform_int_distribution<int> column(0, frame.columns - 1);
    std::uniform_int_distribution<int> row(0, frame.rows - 1);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const int c = column(random);
        const int r = row(random);
        const geo::LatLon place = frame.lat_lon({static_cast<double>(c), static_cast<double>(r)});
        worst = std::max(worst, std::abs(grid.at(c, r) - geoid->undulation(place).m));
    }
    EXPECT_LE(worst, UndulationGrid::kMaxErrorM) << "shift " << grid.shift();
    RecordProperty("shift", grid.shift());

    // The padding is covered, and is finite.
    const int last = frame.padded_side() - 1;
    EXPECT_TRUE(std::isfinite(grid.at(last, last)));
    EXPECT_TRUE(std::isfinite(grid.at(0, last)));
}

INSTANTIATE_TEST_SUITE_P(
    Frames, UndulationGrids,
    testing::Values(frame_of(-125, 49, 1.0 / 3600, 3601, 3601),   // the most common tile
                    frame_of(86, 28, 1.0 / 1200, 1201, 1201),     // Everest: the steepest geoid on land
                    frame_of(78, 8, 1.0 / 1200, 1201, 1201),      // the Indian Ocean's low
                    frame_of(177, -16, 1.0 / 120, 900, 500),      // across the antimeridian
                    frame_of(-180, 90, 1.0 / 12, 500, 40),        // at the north pole
                    frame_of(10, -89, 1.0 / 600, 100, 601),       // at the south pole, padding beyond it
                    frame_of(-180, 90, 1.0 / 120, 20000, 10000),  // more nodes than are kept
                    test_polar(geo::FrameKind::ups_north, 30, 1001),
                    test_polar(geo::FrameKind::ups_south, 30, 1001),
                    test_polar(geo::FrameKind::ups_north, 5000, 600), frame_of(3, 54, 1.0 / 120, 720, 480),
                    frame_of(5, 5, 1e-5, 3, 3)));

TEST(UndulationGrid, IsTheSplineWherePostsAreFarApart) {
    const auto geoid = egm96();
    if (!geoid) GTEST_SKIP() << "no geoid";
    const geo::GridFrame frame = frame_of(-180, 90, 1.0 / 12, 4321, 2161);  // ETOPO5
    const UndulationGrid grid(geoid, frame);
    EXPECT_EQ(grid.memory_bytes(), 0);
    for (int column = 0; column < 4321; column += 7) {
        const geo::LatLon place = frame.lat_lon({static_cast<double>(column), 360});
        EXPECT_EQ(grid.at(column, 360), geoid->undulation(place).m);
    }
}

TEST(UndulationGrid, NoneIsZeroEverywhere) {
    const UndulationGrid none;
    EXPECT_EQ(none.at(17, 4), 0);
    EXPECT_EQ(none.at(geo::GridPosition{1e6, -3}), 0);
}

}  // namespace
}  // namespace relevo::test
