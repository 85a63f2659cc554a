#include "viewer/bench/open_sea.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

constexpr int kColumns = 700;  // pages of 256 cells: three by two
constexpr int kRows = 400;

/// Sea where is_sea(column, row), its bed at H(column, row).
template <class IsSea, class Height>
lod::Terrain coast(const IsSea& is_sea, const Height& H) {
    const auto frame = geographic_frame(kColumns, kRows, 10, 20, 0.001);
    lod::Raster<std::uint8_t> sea(kColumns, kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) sea.at(column, row) = is_sea(column, row) ? 255 : 0;
    }
    return make_terrain(
        frame,
        make_heights(frame, [&](int column, int row) { return is_sea(column, row) ? H(column, row) : 9; }),
        lod::ErrorMetric::bounded, {}, sea);
}

constexpr auto flat = [](int, int) { return 0; };

geo::GridPosition found(const lod::Terrain& terrain, double bed_m = 0) {
    const auto place = viewer::open_sea(*terrain.pyramid(), bed_m);
    EXPECT_TRUE(place && *place);
    return terrain.frame().grid_position(**place);
}

TEST(OpenSea, IsTheMiddleOfTheWidestWater) {
    // A lake-like bay in the west, the ocean in the east.
    const auto is_sea = [](int column, int row) {
        return column > 380 || (column > 10 && column < 150 && row > 10 && row < 150);
    };
    const auto at = found(coast(is_sea, flat));
    EXPECT_GT(at.column, 380 + 64);
    for (const int corner : {0, 1, 2, 3}) {
        EXPECT_TRUE(is_sea(static_cast<int>(at.column) + (corner & 1 ? 64 : -64),
                           static_cast<int>(at.row) + (corner & 2 ? 64 : -64)));
    }
}

TEST(OpenSea, IsDeepWhereThereIsDeepWater) {
    const auto is_sea = [](int column, int) { return column > 100; };
    const auto bed = [](int column, int) { return column > 500 ? -500 : -5; };
    const auto terrain = coast(is_sea, bed);
    EXPECT_GT(found(terrain, -50).column, 500);
    EXPECT_LT(found(terrain).column, 500) << "nearer to the middle";
    EXPECT_LT(found(terrain, -1000).column, 500) << "there is none so deep";
}

TEST(OpenSea, IsFoundInANarrowStrait) {
    const auto at = found(coast([](int column, int) { return std::abs(column - 330) < 20; }, flat));
    EXPECT_NEAR(at.column, 330, 20);
}

TEST(OpenSea, IsNotThereWithoutWideWater) {
    const auto dry = coast([](int, int) { return false; }, flat);
    const auto none = viewer::open_sea(*dry.pyramid(), 0);
    ASSERT_TRUE(none);
    EXPECT_FALSE(*none);
    const auto river = coast([](int column, int) { return std::abs(column - 330) < 5; }, flat);
    const auto narrow = viewer::open_sea(*river.pyramid(), 0);
    ASSERT_TRUE(narrow);
    EXPECT_FALSE(*narrow);
}

TEST(OpenSea, OffShoreIsFarFromLand) {
    const auto terrain = coast([](int column, int) { return column > 200; }, flat);
    viewer::OffShore off_shore(*terrain.pyramid());
    const auto at = [&](double column, double row) {
        return off_shore.at(terrain.frame().lat_lon({column, row}));
    };
    EXPECT_FALSE(at(100, 100));
    EXPECT_FALSE(at(230, 100));
    EXPECT_FALSE(at(300, 100)) << "within 64 posts of a page that has land";
    EXPECT_TRUE(at(330, 100));
    EXPECT_TRUE(at(699, 399));
    EXPECT_TRUE(at(800, 100)) << "beyond the data its edge goes on";
}

}  // namespace
}  // namespace relevo::test
