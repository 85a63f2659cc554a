#include "lod/measure/slope.hpp"

#include <cmath>

#include "geo/ellipsoid.hpp"
#include "geo/geodesic.hpp"
#include "lod/measure/point.hpp"
#include "tests/lod/measured_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

using test::grid;
using test::lat_lon;
using test::MeasuredScene;
using test::rough;

TEST(SurfaceSlope, OfPlanesInEveryDirection) {
    const double step = 0.0005;
    const double east_m = geo::wgs84::kSemiMajor * geo::Degrees{step}.radians();
    const double north_m = east_m * (1 - geo::wgs84::kEccentricity2);
    for (int azimuth = 0; azimuth < 360; azimuth += 15) {
        const double a = geo::Degrees{azimuth + 0.0}.radians();
        MeasuredScene scene(grid(0, 0.005, step, 21, 21), [&](int column, int row) {
            return 500 - 0.7 * ((column - 10) * east_m * std::sin(a) - (row - 10) * north_m * std::cos(a));
        });
        for (const auto at : {geo::GridPosition{3.3, 7.8}, geo::GridPosition{4, 9}, geo::GridPosition{0, 0},
                              geo::GridPosition{20, 12.5}}) {
            const auto slope = surface_slope(scene.sampler(), scene.frame().lat_lon(at));
            ASSERT_TRUE(slope && *slope);
            EXPECT_NEAR((*slope)->degrees, geo::Degrees::from_radians(std::atan(0.7)).value, 1e-4);
            EXPECT_NEAR(std::remainder((*slope)->aspect->value - azimuth, 360), 0, 1e-3);
        }
    }
}

TEST(SurfaceSlope, IsThatOfHeightsAroundInPolarGridsToo) {
    for (const auto kind : {geo::FrameKind::ups_north, geo::FrameKind::ups_south}) {
        MeasuredScene scene(test::polar_frame(kind, 20, 20, 50, 7000, -4000), rough);
        const auto place = scene.frame().lat_lon({7.4, 8.3});
        const auto slope = surface_slope(scene.sampler(), place);
        ASSERT_TRUE(slope && *slope);
        // Heights a centimetre to each side.
        const auto height = [&](double azimuth) {
            return static_cast<double>(
                scene.brute_height(geo::geodesic_destination(place, geo::Degrees{azimuth}, 0.01)));
        };
        const double east = (height(90) - height(270)) / 0.02;
        const double north = (height(0) - height(180)) / 0.02;
        EXPECT_NEAR((*slope)->degrees, geo::Degrees::from_radians(std::atan(std::hypot(east, north))).value,
                    1e-3);
        const double aspect = geo::Degrees::from_radians(std::atan2(-east, -north)).value;
        EXPECT_NEAR(std::remainder((*slope)->aspect->value - aspect, 360), 0, 1e-2);
    }
}

TEST(SurfaceSlope, LevelGroundHasNoAspectAndVoidsNoSlope) {
    MeasuredScene scene(grid(0, 0.05, 0.01, 11, 11),
                        [](int column, int row) { return column == 5 && row == 5 ? NAN : 100.0; });
    const auto at = [&](double column, double row) {
        return measure_point(scene.sampler(), scene.frame().lat_lon({column, row}));
    };
    const auto level = at(2.3, 2.9);
    ASSERT_TRUE(level && level->slope);
    EXPECT_EQ(level->slope->degrees, 0);
    EXPECT_FALSE(level->slope->aspect);
    EXPECT_EQ(level->nearest_post->column, 2);
    EXPECT_EQ(level->nearest_post->row, 3);
    EXPECT_EQ(level->nearest_post->H_m, 100);
    EXPECT_NEAR(level->nearest_post->distance_m, 1113.2 * std::hypot(0.3, 0.1), 2);
    const auto hole = at(5.2, 5.1);
    EXPECT_FALSE(hole->slope || hole->nearest_post->H_m);
    EXPECT_TRUE(at(4, 4)->slope);  // three of its cells have heights
    EXPECT_FALSE(at(-3, 4)->slope || at(-3, 4)->nearest_post);
}

}  // namespace
}  // namespace relevo::lod
