#include <cmath>
#include <limits>
#include <random>

#include "lod/measure/grid_path.hpp"
#include "lod/measure/line.hpp"
#include "lod/measure/profile.hpp"
#include "tests/lod/marched_line.hpp"

namespace relevo::lod {
namespace {

using test::Ends;
using test::expect_right;
using test::grid;
using test::lat_lon;
using test::measure;
using test::MeasuredScene;
using test::profile_of;
using test::rough;

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

// --- Against marching

TEST(MeasureLine, EqualsMarchingOverRoughGround) {
    MeasuredScene scene(grid(10, 50, 0.001, 200, 150), rough);
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    expect_right(scene, {at(1.3, 2.7), at(190.2, 140.9)}, 5000, 1e-7, 0.02);  // any direction
    expect_right(scene, {at(17, 3), at(17, 149)}, 5000, 1e-7, 0.02);          // along a column of posts
    expect_right(scene, {at(17.5, 3), at(17.5, 149)}, 5000, 1e-7, 0.02);      // a meridian between columns
    expect_right(scene, {at(3, 50), at(180, 50)}, 5000, 1e-7, 0.02);          // next to a row
    expect_right(scene, {at(5, 5), at(105, 105)}, 5000, 1e-7, 0.02);          // post to post
    expect_right(scene, {at(20.1, 20.1), at(20.9, 20.3)}, 1000, 1e-7, 1e-3);  // within a cell
    expect_right(scene, {at(20.5, 20.5), at(21.5, 20.5)}, 1000, 1e-7, 1e-3);
    expect_right(scene, {at(0, 0), at(0, 149)}, 5000, 1e-7, 0.02);  // the data's own border
}

TEST(MeasureLine, EqualsMarchingOnRandomShortLines) {
    MeasuredScene scene(grid(-70, 70, 0.002, 60, 60), rough);
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> place(1, 58);
    std::uniform_real_distribution<double> step(-1, 1);
    for (int i = 0; i < 60; ++i) {
        const double column = place(random);
        const double row = place(random);
        const auto from = scene.frame().lat_lon({column, row});
        const auto to = scene.frame().lat_lon({column + step(random), row + step(random)});
        expect_right(scene, {from, to}, 100, 1e-7, 1e-3);
    }
}

TEST(MeasureLine, EqualsMarchingWithAGeoid) {
    const auto frame = grid(10, 50, 0.01, 33, 33);
    MeasuredScene scene(
        frame, [](int column, int row) { return 30.0 * column + 20 * row; }, VerticalDatum::egm96,
        test::sloping_geoid(frame, 16, 0));  // steep: 0.5 m a post
    expect_right(scene, {frame.lat_lon({1.5, 2.5}), frame.lat_lon({30.5, 28.5})}, 10000, 1e-8, 1e-4);
}

TEST(MeasureLine, EqualsMarchingAcrossTheAntimeridian) {
    MeasuredScene scene(grid(179.9, -16, 0.002, 101, 61), rough);
    for (const double turn : {0.0, 360.0}) {
        expect_right(scene, {lat_lon(-16.01, 179.91), lat_lon(-16.1, 180.09 - turn)}, 5000, 1e-7, 0.02);
        expect_right(scene, {lat_lon(-16.01, 179.91 - turn), lat_lon(-16.1, -179.91)}, 5000, 1e-7, 0.02);
    }
    expect_right(scene, {lat_lon(-16.01, 180), lat_lon(-16.1, -180)}, 5000, 1e-7, 0.02);
}

TEST(MeasureLine, EqualsMarchingRoundTheEarth) {
    // Cells of 1 degree, where a geodesic is far from straight; over the seam, over a pole, along the
    // equator.
    MeasuredScene scene(grid(-180, 90, 1, 361, 181), [](int column, int row) {
        return row == 0 || row == 180 ? 500 : rough(column % 360, row);
    });
    const std::vector<Ends> lines{
        {lat_lon(40, -74), lat_lon(35.5, 139.8)},   {lat_lon(-34, 151), lat_lon(-33, -71)},
        {lat_lon(60.2, 25), lat_lon(61.2, -150)},   {lat_lon(0, 10), lat_lon(0, 170)},
        {lat_lon(80, 10.5), lat_lon(80, -169.5)},   {lat_lon(-89.5, 5), lat_lon(-20, 150)},
        {lat_lon(90, 0), lat_lon(-90, 0)},          {lat_lon(10, 170), lat_lon(12, -170)},
        {lat_lon(-10, 180), lat_lon(70, 180)},      {lat_lon(-30, 0), lat_lon(29.9, 179.5)},
        {lat_lon(50.5, 20), lat_lon(50.5, -100.25)}};
    for (const Ends& ends : lines) {
        SCOPED_TRACE(testing::Message() << ends.from.lat.value << ' ' << ends.from.lon.value);
        expect_right(scene, ends, 20000, 1e-7, 0.02);
    }
}

TEST(MeasureLine, ASpikeCostsNoDigits) {
    MeasuredScene scene(grid(10, 50, 1.0 / 3600, 40, 40),
                        [](int c, int r) { return c == 20 && r == 20 ? 8000 : 0; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    // Along a meridian, which is a geodesic: over the very top.
    const auto line = measure(scene, {at(20, 18.2), at(20, 22)});
    EXPECT_NEAR(line.climb_m.value_or(0), 8000, 1e-5);  // 2e-8 m at a slope of 259
    EXPECT_NEAR(line.descent_m.value_or(0), 8000, 1e-5);
    expect_right(scene, {at(18.2, 20), at(22, 20)}, 1000, 1e-7, 0.01);
    expect_right(scene, {at(18.2, 19.2), at(22.1, 20.9)}, 1000, 1e-7, 0.01);
}

// --- Closed forms

TEST(MeasureLine, LevelGroundIsTheGeodesicAtItsHeight) {
    for (const double h : {0.0, 4000.0}) {
        MeasuredScene scene(grid(0, 1, 0.01, 201, 201), [h](int, int) { return h; });
        // Along the equator the earth's radius is the semi-major axis: (a + h) times the angle.
        const auto line = measure(scene, {lat_lon(0, 0.1), lat_lon(0, 1.1)});
        ASSERT_TRUE(line.surface_m);
        EXPECT_NEAR(*line.surface_m, (6378137 + h) * std::numbers::pi / 180, 1e-6);
        EXPECT_EQ(line.climb_m, 0);
        EXPECT_EQ(line.descent_m, 0);
    }
}

TEST(MeasureLine, ClimbOfAPlaneIsTheDifferenceOfItsEnds) {
    MeasuredScene scene(grid(10, 50, 0.001, 300, 300),
                        [](int column, int row) { return 3.0 * column + 5.0 * row; });
    const auto from = scene.frame().lat_lon({10.25, 20.5});
    const auto to = scene.frame().lat_lon({250.75, 270.125});
    const auto line = measure(scene, {from, to});
    ASSERT_TRUE(line.climb_m);
    EXPECT_NEAR(*line.climb_m, 3 * 240.5 + 5 * 249.625, 1e-7);
    EXPECT_EQ(line.descent_m, 0);
}

TEST(MeasureLine, ASlopeIsAsLongAsItsHypotenuse) {
    // Along the equator on a plane that rises evenly from 0: sqrt((1 + h/a)^2 + p^2) with p = dh/ds,
    // integrated.
    MeasuredScene scene(grid(0, 0.1, 0.001, 201, 201), [](int column, int) { return 50.0 * column; });
    const auto line = measure(scene, {lat_lon(0, 0), lat_lon(0, 0.2)});
    ASSERT_TRUE(line.surface_m);
    const double length = line.geodesic.length_m;
    const double p = 10000 / length;
    double expected = 0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i)
        expected += std::hypot(1 + 10000 * (i + 0.5) / kSteps / 6378137, p) * length / kSteps;
    EXPECT_NEAR(*line.surface_m / expected, 1, 1e-10);
}

TEST(MeasureLine, ExtremumInsideACellCounts) {
    // A saddle: along its diagonal H = 100 u (1 - u) has its peak of 25 m in the middle, seen from no edge.
    MeasuredScene scene(grid(0, 0.005, 0.01, 2, 2),
                        [](int column, int row) { return column != row ? 50 : 0; });
    const auto corner = [&](int column, int row) {
        return scene.frame().lat_lon({double(column), double(row)});
    };
    const auto line = measure(scene, {corner(0, 0), corner(1, 1)});
    ASSERT_TRUE(line.climb_m);
    EXPECT_NEAR(*line.climb_m, 25, 1e-6);
    EXPECT_NEAR(*line.descent_m, 25, 1e-6);
    const auto samples = profile_of(scene, {corner(0, 0), corner(1, 1)});
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_NEAR(samples[1].H_m.value_or(0), 25, 1e-6);
    EXPECT_NEAR(samples[1].distance_m, line.geodesic.length_m / 2, 0.01);
}

// --- Ends and gaps

TEST(MeasureLine, NoLengthIsNothing) {
    MeasuredScene scene(grid(10, 50, 0.01, 20, 20), rough);
    for (const auto place : {lat_lon(49.95, 10.05), lat_lon(50, 10), lat_lon(49.9512, 10.0533)}) {
        const auto line = measure(scene, {place, place});
        EXPECT_EQ(line.geodesic.length_m, 0);
        EXPECT_EQ(line.surface_m, 0);
        EXPECT_EQ(line.climb_m, 0);
        EXPECT_EQ(line.descent_m, 0);
        const auto samples = profile_of(scene, {place, place});
        ASSERT_EQ(samples.size(), 1U);
        EXPECT_TRUE(samples[0].H_m);
    }
    const auto outside = lat_lon(0, 0);
    EXPECT_FALSE(measure(scene, {outside, outside}).surface_m);
    EXPECT_FALSE(profile_of(scene, {outside, outside}).front().H_m);
}

TEST(MeasureLine, GroundIsUnknownOutside) {
    MeasuredScene scene(grid(10, 50, 0.01, 20, 20), rough);
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    for (const Ends& ends : {Ends{at(5, 5), at(25, 6)}, Ends{at(-5, 5), at(25, 6)}, Ends{at(-5, 5), at(5, 5)},
                             Ends{at(-5, -5), at(-6, 30)}, Ends{lat_lon(0, 0), lat_lon(80, 170)},
                             Ends{at(-1, 0.5), at(0.5, -1)}}) {
        const auto line = measure(scene, ends);
        EXPECT_FALSE(line.surface_m || line.climb_m || line.descent_m);
        EXPECT_GT(line.geodesic.length_m, 0);
    }
}

TEST(MeasureLine, ProfileSaysWhereGapsBeginAndEnd) {
    MeasuredScene scene(grid(10, 50, 0.01, 20, 20),
                        [](int column, int row) { return column == 10 && row == 5 ? kVoid : 100; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const auto samples = profile_of(scene, {at(-3, 5.5), at(22, 5.5)});
    // outside, data, void around column 10, data, outside
    std::vector<std::pair<double, bool>> changes;
    for (const auto& sample : samples)
        if (changes.empty() || changes.back().second != sample.H_m.has_value())
            changes.emplace_back(scene.frame().grid_position(sample.place).column, sample.H_m.has_value());
    ASSERT_EQ(changes.size(), 5U);
    EXPECT_NEAR(changes[1].first, 0, 1e-5);
    EXPECT_NEAR(changes[2].first, 9, 1e-5);
    EXPECT_NEAR(changes[3].first, 11, 1e-5);
    EXPECT_NEAR(changes[4].first, 19, 1e-5);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i].H_m.has_value() != samples[i - 1].H_m.has_value()) {
            EXPECT_NEAR(samples[i].distance_m, samples[i - 1].distance_m, 1e-6);
        }
    }
    EXPECT_FALSE(measure(scene, {at(3, 5.5), at(18, 5.5)}).surface_m);
    EXPECT_TRUE(measure(scene, {at(3, 7.5), at(18, 7.5)}).surface_m);
}

TEST(MeasureLine, ALineThroughAVoidsCornerOnlyTouchesIt) {
    // From the cell north-west of post (9, 4) to the cell south-east... the void's cells are (9..10, 4..5).
    MeasuredScene scene(grid(0, 0.05, 0.01, 20, 11),
                        [](int column, int row) { return column == 10 && row == 5 ? kVoid : 100; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    EXPECT_TRUE(measure(scene, {at(9, 2), at(9, 9)}).surface_m);  // along the border of the void
    EXPECT_FALSE(measure(scene, {at(9.1, 2), at(9.1, 9)}).surface_m);
}

TEST(MeasureLine, MeetsTheDataTwice) {
    // A geodesic far north bulges towards the pole: it leaves the data over its northern border and comes
    // back.
    MeasuredScene scene(grid(0, 60, 0.1, 601, 101), rough);
    const auto samples = profile_of(scene, {lat_lon(59, 1), lat_lon(59, 59)});
    int gaps = 0;
    for (std::size_t i = 1; i < samples.size(); ++i)
        gaps += samples[i - 1].H_m.has_value() && !samples[i].H_m.has_value() ? 1 : 0;
    EXPECT_EQ(gaps, 1);
    EXPECT_TRUE(samples.front().H_m && samples.back().H_m);
}

// --- Crossings

TEST(GridPath, CrossingsAreWhereRowsAndColumnsAreWhole) {
    const auto frame = grid(-180, 90, 0.5, 721, 361);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> lat(-90, 90);
    std::uniform_real_distribution<double> lon(-180, 180);
    for (int i = 0; i < 100; ++i) {
        const GridPath path(frame, lat_lon(lat(random), lon(random)), lat_lon(lat(random), lon(random)));
        double last = 0;
        for (const auto& stretch : path.stretches()) {
            EXPECT_NEAR(stretch.cuts.front(), last, 0.1);  // 1e-6 posts
            for (std::size_t k = 0; k < stretch.cuts.size(); ++k) {
                EXPECT_GE(stretch.cuts[k], last);
                last = stretch.cuts[k];
                if (k == 0 || k + 1 == stretch.cuts.size()) continue;
                const auto place = path.at(last, stretch.turn);
                const double off = std::min(std::abs(std::remainder(place.grid.column, 1)) /
                                                std::max(1.0, std::abs(place.columns_per_m) * 1e5),
                                            std::abs(std::remainder(place.grid.row, 1)));
                EXPECT_LT(off, 1e-10);
                // No whole row or column between two cuts.
                const auto middle = path.at(0.5 * (stretch.cuts[k - 1] + last), stretch.turn).grid;
                const auto before = path.at(stretch.cuts[k - 1], stretch.turn).grid;
                EXPECT_LT(std::abs(place.grid.column - before.column), 1 + 1e-6);
                EXPECT_LT(std::abs(place.grid.row - before.row), 1 + 1e-6);
                EXPECT_EQ(std::floor(middle.column), std::floor(0.5 * (before.column + place.grid.column)));
            }
        }
        EXPECT_NEAR(last, path.length_m(), 0.1);
    }
}

}  // namespace
}  // namespace relevo::lod
