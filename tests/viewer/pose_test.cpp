#include "viewer/pose.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "geo/geodesic.hpp"
#include "lod/view.hpp"

namespace relevo::viewer {
namespace {

Pose pose_at(double lat, double lon, double h, double heading) {
    return {{geo::Degrees{lat}, geo::Degrees{lon}, {h}},
            geo::Degrees{heading},
            geo::Degrees{-10},
            geo::Degrees{0}};
}

double angle_between(geo::Degrees a, geo::Degrees b) {
    return std::abs(geo::wrapped_180(a - b).value);
}

// Truth: Karney's geodesic. At a height the way over the ground is shorter, by about h / R.
TEST(Pose, FliesAlongGeodesics) {
    for (const auto& [lat, lon, heading] :
         {std::tuple(0.0, 0.0, 90.0), std::tuple(37.5, -105.0, 30.0), std::tuple(-45.0, 179.99, 75.0),
          std::tuple(60.0, -179.99, 280.0), std::tuple(83.9, 0.0, 20.0), std::tuple(-89.0, 10.0, 190.0)}) {
        Pose pose = pose_at(lat, lon, 0, heading);
        for (int i = 0; i < 500; ++i) pose = moved(pose, 200, 0, 0);
        const geo::LatLon from{geo::Degrees{lat}, geo::Degrees{lon}};
        const geo::LatLon to{pose.eye.lat, pose.eye.lon};
        const auto line = geo::geodesic(from, to);
        EXPECT_NEAR(line.length_m, 100e3, 0.1) << lat << " " << lon;
        EXPECT_LT(angle_between(line.azimuth1, geo::Degrees{heading}), 1e-3) << lat << " " << lon;
        EXPECT_LT(angle_between(line.azimuth2, pose.heading), 1e-3) << lat << " " << lon;
        EXPECT_EQ(pose.eye.h.m, 0);
    }
}

TEST(Pose, LongStepsAreShortOnesTogether) {
    Pose slow = pose_at(10, 170, 5e6, 60);
    for (int i = 0; i < 1000; ++i) slow = moved(slow, 2000, 500, 3);
    const Pose fast = moved(pose_at(10, 170, 5e6, 60), 2e6, 5e5, 3000);
    EXPECT_LT(glm::length(geo::to_ecef(slow.eye) - geo::to_ecef(fast.eye)), 20e3);
    EXPECT_NEAR(fast.eye.h.m, 5e6 + 3000, 1e-6);
}

TEST(Pose, CrossesThePole) {
    Pose pose = pose_at(89.9, 20, 3000, 0);
    for (int i = 0; i < 223; ++i) pose = moved(pose, 100, 0, 0);
    EXPECT_NEAR(pose.eye.lat.value, 89.9, 0.002);
    EXPECT_LT(angle_between(pose.eye.lon, geo::Degrees{-160}), 0.1);
    EXPECT_LT(angle_between(pose.heading, geo::Degrees{180}), 0.1);
}

TEST(Pose, TurnsNoFartherThanStraightUpAndDown) {
    const Pose pose = turned(pose_at(0, 0, 10, 350), geo::Degrees{20}, geo::Degrees{200});
    EXPECT_DOUBLE_EQ(pose.heading.value, 10);
    EXPECT_EQ(pose.pitch.value, 90);
    EXPECT_EQ(turned(pose, geo::Degrees{0}, geo::Degrees{-500}).pitch.value, -90);
}

TEST(Pose, GoesRoundAPointWhichStaysWhereItIsInThePicture) {
    const geo::Ecef centre = geo::to_ecef({geo::Degrees{37.58}, geo::Degrees{-105.48}, {4300}});
    Pose pose = pose_at(37.50, -105.60, 5000, 60);
    const auto seen = [&](const Pose& at) {
        const lod::View view({.eye = at.eye,
                              .heading = at.heading,
                              .pitch = at.pitch,
                              .roll = at.roll,
                              .fov = geo::Degrees{60},
                              .width = 1280,
                              .height = 720});
        return view.pixel(centre - view.eye());
    };
    const double distance = glm::length(centre - geo::to_ecef(pose.eye));
    const glm::dvec2 pixel = seen(pose);
    for (int i = 0; i < 90; ++i) {
        pose = orbited(pose, centre, geo::Degrees{4}, geo::Degrees{i < 40 ? 0.5 : -0.4});
        ASSERT_NEAR(glm::length(centre - geo::to_ecef(pose.eye)), distance, 1e-3);
        ASSERT_LT(glm::length(seen(pose) - pixel), 60) << "after " << i;
    }
    // All the way round: back where it was.
    EXPECT_LT(glm::length(seen(pose) - pixel), 30);
}

TEST(Pose, OrbitStopsStraightAboveThePoint) {
    const geo::Ecef centre = geo::to_ecef({geo::Degrees{0}, geo::Degrees{180}, {0}});
    Pose pose = pose_at(-0.05, -179.99, 4000, 0);
    for (int i = 0; i < 100; ++i) pose = orbited(pose, centre, geo::Degrees{0}, geo::Degrees{3});
    EXPECT_NEAR(pose.eye.h.m, std::hypot(4000, 5640), 50);
    EXPECT_TRUE(std::isfinite(pose.heading.value));
}

}  // namespace
}  // namespace relevo::viewer
