#include <array>
#include <cmath>
#include <limits>

#include "lod/measure/path.hpp"
#include "lod/measure/profile.hpp"
#include "tests/lod/measured_scene.hpp"

namespace relevo::lod {
namespace {

using test::grid;
using test::lat_lon;
using test::MeasuredScene;
using test::rough;

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

TEST(MeasurePath, IsTheSumOfItsLines) {
    MeasuredScene scene(grid(10, 50, 0.001, 200, 150), rough);
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const std::array places{at(3, 140), at(50.5, 100.2), at(150, 120), at(150, 20)};
    const auto path = measure_path(scene.sampler(), places);
    ASSERT_TRUE(path) << path.error().message;
    ASSERT_EQ(path->legs.size(), 3u);
    ASSERT_EQ(path->turns.size(), 2u);
    double length = 0;
    double surface = 0;
    double climb = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto line = measure_line(scene.sampler(), places[i], places[i + 1]);
        ASSERT_TRUE(line);
        length += line->geodesic.length_m;
        surface += *line->surface_m;
        climb += *line->climb_m;
        EXPECT_EQ(path->legs[i].geodesic.azimuth1, line->geodesic.azimuth1);
    }
    EXPECT_EQ(path->length_m, length);
    EXPECT_EQ(*path->surface_m, surface);
    EXPECT_EQ(*path->climb_m, climb);
    EXPECT_NEAR(*path->climb_m - *path->descent_m, rough(150, 20) - rough(3, 140), 0.01);
    EXPECT_GT(path->turns[0].value, 0);  // to the right, and then to the left
    EXPECT_LT(path->turns[1].value, 0);
}

TEST(MeasurePath, TurnsAreAnglesOnTheEarth) {
    MeasuredScene scene(grid(10, 50, 0.001, 20, 15), rough);
    const auto turn = [&](std::array<geo::LatLon, 3> places) {
        const auto path = measure_path(scene.sampler(), places);
        return path->turns.front().value;
    };
    EXPECT_NEAR(turn({lat_lon(0, 0), lat_lon(1, 0), lat_lon(1 - 1e-7, 1e-5)}), 90.57, 0.1);
    EXPECT_NEAR(turn({lat_lon(0, 0), lat_lon(0, 1), lat_lon(1, 1)}), -90, 1e-9);
    EXPECT_NEAR(std::abs(turn({lat_lon(0, 0), lat_lon(0, 1), lat_lon(0, 0)})), 180, 1e-9);
}

/// By another way: 400000 steps of long double.
struct Stepped {
    long double mean = 0;
    long double mean_slope = 0;
    double steepest = 0;
};

Stepped stepped(const MeasuredScene& scene, geo::LatLon from, geo::LatLon to, int steps = 400000) {
    const geo::GeodesicPath path(from, to);
    Stepped s;
    long double last = scene.brute_height(from);
    const double step = path.length_m() / steps;
    for (int i = 0; i < steps; ++i) {
        s.mean += scene.brute_height(path.at((i + 0.5) * step)) / steps;
        const long double next = scene.brute_height(path.at((i + 1) * step));
        s.mean_slope += std::abs(next - last) / static_cast<long double>(path.length_m());
        s.steepest = std::max(s.steepest, static_cast<double>((next - last) / step));
        last = next;
    }
    return s;
}

TEST(MeasureProfile, FiguresAreThoseOfTheSurface) {
    MeasuredScene scene(grid(10, 50, 0.001, 60, 60), rough);
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    for (const auto& [from, to] :
         {std::pair{at(1.3, 2.7), at(50.2, 55.9)}, std::pair{at(7, 3), at(7, 50)},
          std::pair{at(2, 20.5), at(55, 20.5)}, std::pair{at(20.1, 20.1), at(20.9, 20.3)}}) {
        const std::array ends{from, to};
        const auto profile = measure_profile(scene.sampler(), ends);
        ASSERT_TRUE(profile) << profile.error().message;
        const auto expected = stepped(scene, from, to);
        EXPECT_NEAR(*profile->mean_H_m, static_cast<double>(expected.mean), 1e-4);
        EXPECT_NEAR(*profile->mean_slope, static_cast<double>(expected.mean_slope),
                    1e-3 * *profile->mean_slope);
        EXPECT_NEAR(profile->steepest_up ? profile->steepest_up->value : 0, expected.steepest,
                    0.003 * expected.steepest);
        EXPECT_NEAR(profile->measured_m, geo::geodesic(from, to).length_m, 1e-6);
        EXPECT_TRUE(profile->gaps.empty());
        // The extremes are samples, and places where the sampler reads them.
        const auto height = scene.sampler().height(scene.frame().grid_position(profile->highest->place));
        EXPECT_NEAR(**height, profile->highest->value, 1e-5);
        for (const auto& sample : profile->samples) {
            EXPECT_LE(*sample.H_m, profile->highest->value);
            EXPECT_GE(*sample.H_m, profile->lowest->value);
        }
    }
}

TEST(MeasureProfile, MeanIsThatOfTheSurfaceAndNotOfSamples) {
    // Half of the line is in wide cells on top, half in narrow ones... of one grid: a step at column 10.
    MeasuredScene scene(grid(0, 0.05, 0.01, 21, 11), [](int column, int) { return column <= 10 ? 0 : 100; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const auto profile = measure_profile(scene.sampler(), std::array{at(0, 5), at(20, 5)});  // the equator
    ASSERT_TRUE(profile);
    EXPECT_NEAR(*profile->mean_H_m, 100 * 9.5 / 20, 1e-9);
    EXPECT_NEAR(*profile->mean_slope, 100 / profile->measured_m, 1e-12);
    EXPECT_FALSE(profile->steepest_down);
    EXPECT_NEAR(profile->steepest_up->value, 100 / (profile->measured_m / 20), 1e-9);
}

TEST(MeasureProfile, GapsAreSaid) {
    MeasuredScene scene(grid(0, 0.05, 0.01, 20, 11), [](int column, int row) {
        return column == 10 && row == 5 ? kVoid : 100.0 + column;
    });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const auto profile = measure_profile(scene.sampler(), std::array{at(-3, 5.5), at(5, 5.5), at(22, 5.5)});
    ASSERT_TRUE(profile);
    const double post = profile->vertices_m[2] / 25;
    ASSERT_EQ(profile->vertices_m.size(), 3u);
    EXPECT_NEAR(profile->vertices_m[1], 8 * post, 1e-3);
    ASSERT_EQ(profile->gaps.size(), 3u);
    const std::array<std::array<double, 3>, 3> expected{{{0, 3, 1}, {12, 14, 0}, {22, 25, 1}}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(profile->gaps[i].from_m, expected[i][0] * post, 1e-2);
        EXPECT_NEAR(profile->gaps[i].to_m, expected[i][1] * post, 1e-2);
        EXPECT_EQ(profile->gaps[i].outside, expected[i][2] == 1);
    }
    EXPECT_NEAR(profile->measured_m, 17 * post, 1e-2);
    EXPECT_NEAR(*profile->mean_H_m, (9 * 104.5 + 8 * 115 - 0) / 17.0, 0.6);

    const auto nothing = measure_profile(scene.sampler(), std::array{at(30, 5), at(40, 5)});
    ASSERT_TRUE(nothing);
    EXPECT_FALSE(nothing->mean_H_m || nothing->lowest || nothing->mean_slope || nothing->steepest_up);
    ASSERT_EQ(nothing->gaps.size(), 1u);
    EXPECT_TRUE(nothing->gaps[0].outside);
    const auto still = measure_profile(scene.sampler(), std::array{at(3, 5), at(3, 5)});
    ASSERT_TRUE(still);
    EXPECT_EQ(still->highest->value, 103);
    EXPECT_FALSE(still->mean_H_m);
}

}  // namespace
}  // namespace relevo::lod
