#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"
#include "viewer/frame_block.hpp"

namespace relevo::viewer {
namespace {

// The vertex shader's arithmetic in float, against View::pixel in double. What it may lose is part of the
// 0.01 pixel within which a camera's step of 1 mm has to move every vertex as geometry says.
TEST(Projection, FloatsInTheShaderLoseNothingThatShows) {
    const auto frame = test::geographic_frame(65, 65);
    const auto terrain = test::make_terrain(frame, test::make_heights(frame, [](int, int) { return 0.0; }));
    constexpr unsigned kSeed = 11;
    std::mt19937 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    for (int i = 0; i < 2000; ++i) {
        const lod::View view(
            {.eye = {geo::Degrees{any(-90, 90)}, geo::Degrees{any(-180, 180)}, {any(0, 1e5)}},
             .heading = geo::Degrees{any(0, 360)},
             .pitch = geo::Degrees{any(-90, 90)},
             .roll = geo::Degrees{any(-180, 180)},
             .fov = geo::Degrees{any(1, 120)},
             .width = 1280,
             .height = 720});
        // The whole picture, and a tile of it: its window's pixels are counted from its own corner.
        const Window window = i % 2 == 0 ? Window{0, 0, 1280, 720} : Window{512, 256, 512, 512};
        const FrameBlock block = frame_block(view, terrain, window, {}, {}, 1, 0, false);
        const glm::dvec2 wanted(window.x + any(0, window.width), window.y + any(0, window.height));
        const glm::vec3 offset(view.ray(wanted) * std::exp(any(0, 16)));  // 1 m to 9000 km
        const glm::vec4 clip = block.clip_from_offset * glm::vec4(offset, 1);
        const glm::dvec2 drawn(window.x + (0.5 + 0.5 * static_cast<double>(clip.x / clip.w)) * window.width,
                               window.y + (0.5 - 0.5 * static_cast<double>(clip.y / clip.w)) * window.height);
        EXPECT_LT(glm::length(drawn - view.pixel(glm::dvec3(offset))), 0.002) << "seed " << kSeed;
        EXPECT_GT(clip.z, 0);
        EXPECT_LE(clip.z, clip.w);
    }
}

}  // namespace
}  // namespace relevo::viewer
