#include "viewer/haze.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::Haze;

TEST(Haze, IsReadAsItIsWritten) {
    for (const Haze& haze : {Haze{}, Haze{.on = false}, Haze{.visibility_km = 7.25}})
        EXPECT_EQ(*viewer::parse_haze(to_string(haze)), haze);
    for (const char* text : {"", "0", "-1", "fog", "1e9", "nan", "10,20"})
        EXPECT_EQ(viewer::parse_haze(text).error().kind, ErrorKind::usage) << text;
}

// A plain at the sea's level, seen along the ground at a known distance: what is left of its contrast with
// the haze is exp(-3.912 d / V), 2 % at the visibility.
TEST(Haze, LeavesTwoPercentAtTheVisibility) {
    const auto frame = geographic_frame(257, 257);
    Studio studio(make_terrain(frame, make_heights(frame, [](int, int) { return 0.0; })));
    auto camera = above_looking_down(studio.terrain(), 128, 250, 60);
    camera.pitch.value = -1;
    camera.fov.value = 1;
    const lod::View view(camera);
    const glm::dvec3 ray = view.ray({100.5, 75.5});
    const double c = -glm::dot(ray, geo::EnuFrame(camera.eye).up());
    const double metres = 60 / c;  // the earth's curve adds 0.6 %
    const auto grey = [&](Haze haze) {
        const auto p = studio.draw(camera, {.layer = viewer::Layer::hillshade, .haze = haze}).at(100, 75);
        return glm::dvec3(p[0], p[1], p[2]);
    };
    const glm::dvec3 clear = grey({.on = false});
    const glm::dvec3 haze = grey({.visibility_km = 0.05});
    // shaders/frame.glsl: what haze itself looks like by day.
    EXPECT_LT(glm::distance(haze, 255.0 * glm::dvec3(0.80, 0.86, 0.92)), 3);
    for (const double visibility_m : {2 * metres, metres, 5 * metres}) {
        const glm::dvec3 seen = grey({.visibility_km = visibility_m / 1000});
        const double left = glm::distance(seen, haze) / glm::distance(clear, haze);
        EXPECT_NEAR(left, std::exp(-3.912 * metres / visibility_m), 0.02) << visibility_m;
    }
}

}  // namespace
}  // namespace relevo::test
