#include "lod/measure/plane.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "lod/measure/profile.hpp"
#include "tests/lod/measured_scene.hpp"

namespace relevo::lod {
namespace {

using test::grid;
using test::MeasuredScene;

/// A bowl whose floor is at 100 m, with a notch in its border.
MeasuredScene bowl() {
    return MeasuredScene(grid(46, 8, 1.0 / 1200, 41, 41), [](int column, int row) {
        const double x = column - 20;
        const double y = row - 20;
        return 100 + 0.5 * (x * x + y * y) + 3 * std::sin(0.9 * x);
    });
}

std::vector<geo::LatLon> corners(const MeasuredScene& scene) {
    std::vector<geo::LatLon> places;
    for (const geo::GridPosition& at :
         {geo::GridPosition{6, 7}, {6.5, 33}, {33, 34}, {34.25, 20}, {32, 6}, {20, 8}})
        places.push_back(scene.frame().lat_lon(at));
    return places;
}

AreaMeasurement measure(MeasuredScene& scene, const Plane& plane) {
    const auto area = measure_area(scene.sampler(), corners(scene), plane);
    EXPECT_TRUE(area) << area.error().message;
    return area ? *area : AreaMeasurement{};
}

TEST(Plane, OfTheMeanHasAsMuchAboveAsBelow) {
    auto scene = bowl();
    const auto area = measure(scene, {Plane::Kind::mean, 0});
    EXPECT_EQ(*area.plane_H_m, *area.mean_H_m);
    EXPECT_GT(*area.volume_above_m3, 1e6);
    EXPECT_NEAR(*area.volume_above_m3 / *area.volume_below_m3, 1, 1e-9);
}

TEST(Plane, OfTheBorderIsTheLowestOfItsSides) {
    auto scene = bowl();
    const auto area = measure(scene, {Plane::Kind::border, 0});
    // Brute force along the geodesics.
    auto places = corners(scene);
    places.push_back(places.front());
    double lowest = 1e9;
    for (std::size_t i = 1; i < places.size(); ++i) {
        const geo::GeodesicPath side(places[i - 1], places[i]);
        for (int k = 0; k <= 2000; ++k) {
            const auto H =
                scene.sampler().height(scene.frame().grid_position(side.at(side.length_m() * k / 2000)));
            ASSERT_TRUE(H && *H);
            lowest = std::min(lowest, **H);
        }
    }
    EXPECT_NEAR(*area.plane_H_m, lowest, 0.02);
    EXPECT_LE(*area.plane_H_m, lowest + 1e-9);
    EXPECT_GT(*area.plane_H_m, area.lowest->value + 20) << "the floor is no border";
    EXPECT_GT(*area.volume_below_m3, 1e6);
}

TEST(Plane, OfTheLowestOrGivenIsThatOfMeasureArea) {
    auto scene = bowl();
    EXPECT_EQ(measure(scene, {}).volume_below_m3, 0);
    EXPECT_EQ(measure(scene, {}).plane_H_m, measure(scene, {}).lowest->value);
    const auto given = measure(scene, {Plane::Kind::given, 150});
    const auto same = measure_area(scene.scene(), corners(scene), {150, {}});
    ASSERT_TRUE(same);
    EXPECT_EQ(given.volume_above_m3, same->volume_above_m3);
}

TEST(Plane, AVoidBorderHasNoPlane) {
    MeasuredScene scene(grid(46, 8, 1.0 / 1200, 41, 41), [](int column, int row) {
        return std::hypot(column - 20, row - 20) > 5 ? std::nan("") : 100.0;
    });
    const auto area = measure_area(scene.sampler(), corners(scene), Plane{Plane::Kind::border, 0});
    ASSERT_FALSE(area);
    EXPECT_EQ(area.error().kind, ErrorKind::input);
    EXPECT_NE(area.error().message.find("mean"), std::string::npos) << "says what else there is";
}

TEST(Plane, IsStoppedAtAnyTime) {
    auto scene = bowl();
    for (const auto kind : {Plane::Kind::lowest, Plane::Kind::border, Plane::Kind::mean})
        EXPECT_FALSE(
            measure_area(scene.sampler(), corners(scene), Plane{kind, 0}, [](double) { return false; }));
    EXPECT_FALSE(measure_area(scene.sampler(), corners(scene), Plane{Plane::Kind::mean, 0},
                              [](double done) { return done <= 0.5; }));
}

TEST(Plane, TextIsReadAgainToTheLastBit) {
    for (const Plane& plane : {Plane{}, Plane{Plane::Kind::border, 0}, Plane{Plane::Kind::mean, 0},
                               Plane{Plane::Kind::given, -430.1}, Plane{Plane::Kind::given, 1.0 / 3}})
        EXPECT_EQ(*parse_plane(to_string(plane)), plane);
    for (const char* wrong : {"", "least", "12m", "nan", "inf", "mean ", "1,5"}) {
        const auto plane = parse_plane(wrong);
        ASSERT_FALSE(plane) << wrong;
        EXPECT_EQ(plane.error().kind, ErrorKind::usage);
    }
}

}  // namespace
}  // namespace relevo::lod
