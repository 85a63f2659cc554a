// Measuring in grids around the poles, against marching along geodesics with heights by a closed form, and
// over the seam of data all round the earth.

#include <cmath>
#include <random>

#include "lod/measure/grid_path.hpp"
#include "lod/measure/point.hpp"
#include "tests/lod/marched_line.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

class MeasureAroundAPole : public testing::TestWithParam<geo::FrameKind> {
  protected:
    geo::LatLon place(double from_pole, double lon) const {
        return lat_lon(GetParam() == geo::FrameKind::ups_north ? 90 - from_pole : from_pole - 90, lon);
    }
};

TEST_P(MeasureAroundAPole, APointIsBilinearAnywhere) {
    MeasuredScene scene(polar_frame(GetParam(), 201, 151, 100, 333.3, -77.7), rough);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> column(0, 200);
    std::uniform_real_distribution<double> row(0, 150);
    for (int i = 0; i < 2000; ++i) {
        const auto here = scene.frame().lat_lon({column(random), row(random)});
        const auto point = lod::measure_point(scene.sampler(), here);
        ASSERT_TRUE(point && point->H);
        EXPECT_NEAR(point->H->m, static_cast<double>(scene.brute_height(here)), 1e-6);
        EXPECT_NEAR(point->resolution_m, 100 / 0.994, 0.01);
    }
    // The pole by any longitude.
    for (const double lon : {0.0, 90.0, -180.0, 33.0}) {
        const auto point = lod::measure_point(scene.sampler(), place(0, lon));
        ASSERT_TRUE(point && point->H);
        EXPECT_NEAR(point->H->m, static_cast<double>(scene.brute_height(place(0, 0))), 1e-6);
    }
    for (const auto outside : {place(180, 0), place(90, 20), place(0.2, 0)}) {
        const auto point = lod::measure_point(scene.sampler(), outside);
        ASSERT_TRUE(point);
        EXPECT_EQ(point->kind, lod::PointClass::outside);
    }
}

TEST_P(MeasureAroundAPole, ALineEqualsMarching) {
    MeasuredScene scene(polar_frame(GetParam(), 201, 151, 100), rough);
    struct Line {
        const char* what;
        geo::GridPosition from;
        geo::GridPosition to;
    };
    const Line lines[] = {{"any direction", {1.3, 2.7}, {190.2, 140.9}},
                          {"along a column, over the pole", {100, 1.5}, {100, 149}},
                          {"along a row, over the pole", {1, 75}, {199.5, 75}},
                          {"next to a row", {3, 50}, {180, 50}},
                          {"from the pole", {100, 75}, {20.25, 13.5}},
                          {"over the pole, aslant", {60.5, 20}, {139.5, 130}},
                          {"within a cell", {20.1, 20.1}, {20.9, 20.3}},
                          {"along the border, which bulges", {0, 0}, {0, 150}}};
    for (const Line& line : lines) {
        SCOPED_TRACE(line.what);
        expect_right(scene, {scene.frame().lat_lon(line.from), scene.frame().lat_lon(line.to)}, 5000, 1e-7,
                     0.02);
    }
}

TEST_P(MeasureAroundAPole, ALineEqualsMarchingOverFarPosts) {
    // Cells of 40 km, to 60 degrees: geodesics are far from straight, and turn past rows and columns.
    MeasuredScene scene(polar_frame(GetParam(), 161, 161, 40e3), rough);
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> from_pole(0, 27);
    std::uniform_real_distribution<double> lon(-180, 180);
    for (int i = 0; i < 10; ++i)
        expect_right(scene, {place(from_pole(random), lon(random)), place(from_pole(random), lon(random))},
                     1000, 1e-7, 0.02);
    for (const double east : {0.0, 45.0, 90.0, 180.0}) {
        expect_right(scene, {place(25, east), place(25, east + 180)}, 1000, 1e-7, 0.02);
        expect_right(scene, {place(25, east), place(25, east + 60)}, 1000, 1e-7, 0.02);
        expect_right(scene, {place(20, east), place(20, east + 179)}, 1000, 1e-7, 0.02);
        // Along a row or a column in its middle, where it turns back.
        expect_right(scene, {place(27, east - 35), place(27, east + 35)}, 1000, 1e-7, 0.02);
        expect_right(scene, {place(26.3, east - 30), place(26.1, east + 31)}, 1000, 1e-7, 0.02);
    }
}

TEST_P(MeasureAroundAPole, CrossingsAreWhereRowsAndColumnsAreWhole) {
    const auto frame = polar_frame(GetParam(), 301, 201, 20e3, 200e3, 50e3);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> from_pole(0, 60);
    std::uniform_real_distribution<double> lon(-180, 180);
    int cuts = 0;
    int turns = 0;
    for (int i = 0; i < 240; ++i) {
        // Every third line turns back at a row or a column.
        const double from = from_pole(random);
        const double axis = 90 * (i % 4);
        const double half = 0.2 * lon(random);
        const auto ends = i % 3 == 0 ? Ends{place(from, axis - half), place(from, axis + half)}
                                     : Ends{place(from, lon(random)), place(from_pole(random), lon(random))};
        const lod::GridPath path(frame, ends.from, ends.to);
        const auto stretches = path.stretches();
        for (std::size_t k = 1; k < stretches.size(); ++k)
            turns += stretches[k].cuts.front() - stretches[k - 1].cuts.back() < 1e-6;
        for (const auto& stretch : stretches) {
            for (std::size_t k = 1; k < stretch.cuts.size(); ++k) {
                ++cuts;
                // No whole row or column between two cuts: by a fine march.
                const auto middle = path.at(0.5 * (stretch.cuts[k - 1] + stretch.cuts[k]), 0).grid;
                for (int part = 0; part <= 20; ++part) {
                    const auto grid =
                        path.at(stretch.cuts[k - 1] + (stretch.cuts[k] - stretch.cuts[k - 1]) * part / 20, 0)
                            .grid;
                    EXPECT_GE(grid.column, std::floor(middle.column) - 2e-6);
                    EXPECT_LE(grid.column, std::ceil(middle.column) + 2e-6);
                    EXPECT_GE(grid.row, std::floor(middle.row) - 2e-6);
                    EXPECT_LE(grid.row, std::ceil(middle.row) + 2e-6);
                }
            }
        }
    }
    EXPECT_GT(turns, 20);
    EXPECT_GT(cuts, 5000);
}

TEST_P(MeasureAroundAPole, SlopesAlongALineAreThoseOfItsCoordinates) {
    const auto frame = polar_frame(GetParam(), 301, 201, 20e3);
    const lod::GridPath path(frame, place(20, 10), place(13, 140));
    for (double s = 1000; s < path.length_m(); s += path.length_m() / 17) {
        const auto here = path.at(s, 0);
        const auto before = path.at(s - 100, 0).grid;
        const auto after = path.at(s + 100, 0).grid;
        EXPECT_NEAR(here.columns_per_m, (after.column - before.column) / 200, 1e-11);
        EXPECT_NEAR(here.rows_per_m, (after.row - before.row) / 200, 1e-11);
    }
}

INSTANTIATE_TEST_SUITE_P(Poles, MeasureAroundAPole,
                         testing::Values(geo::FrameKind::ups_north, geo::FrameKind::ups_south),
                         [](const auto& kind) { return std::string(lod::to_string(kind.param)); });

TEST(MeasureAllRound, TheSeamIsNoGap) {
    // Steps that do not divide a turn: the last column lies 0.2 degrees before the first, or 0.35 after it.
    for (const double step : {0.7, 360.0 / 514, 360.35 / 514}) {
        MeasuredScene scene(grid(-180, 30, step, 515, 60),
                            [](int column, int row) { return rough(column % 514, row); });
        ASSERT_TRUE(scene.frame().closes());
        const auto lat = 30 - 20 * step;
        const double first = scene.heights().at(0, 20);
        for (const double lon : {-180.0, 180.0, -180 + 514 * step, 180 - 1e-9, -180 + 1e-9}) {
            const auto H = scene.sampler().height(scene.frame().grid_position(lat_lon(lat, lon)));
            ASSERT_TRUE(H && *H) << lon;
            EXPECT_NEAR(**H, first, step < 0.701 ? 1e-4 : 1000) << lon;
        }
        // Lines over the seam are whole, and equal backwards.
        const Ends ends{lat_lon(10.3, 175.2), lat_lon(12.1, -173.9)};
        const auto there = measure(scene, ends);
        const auto back = measure(scene, {ends.to, ends.from});
        ASSERT_TRUE(there.surface_m && back.surface_m) << step;
        EXPECT_NEAR(*back.surface_m / *there.surface_m, 1, 1e-7);
        EXPECT_NEAR(*back.climb_m, *there.descent_m, 1e-6 * *there.descent_m);
        for (const auto& sample : profile_of(scene, ends)) EXPECT_TRUE(sample.H_m);
        EXPECT_TRUE(measure(scene, {lat_lon(10.3, 179.95), lat_lon(12.1, -179.9)}).surface_m);
        EXPECT_TRUE(measure(scene, {lat_lon(10.3, 179.95), lat_lon(12.1, 179.95)}).surface_m);
    }
    // Nothing is made up where a whole column is missing.
    MeasuredScene open(grid(-180, 30, 1, 360, 60), rough);
    EXPECT_FALSE(measure(open, {lat_lon(10.3, 175.2), lat_lon(12.1, -173.9)}).surface_m);
}

}  // namespace
}  // namespace relevo::test
