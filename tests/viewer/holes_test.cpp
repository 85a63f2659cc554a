#include <random>

#include <gtest/gtest.h>

#include "lod/soar/pick.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

/// Do rays all round the picture's edge and across it hit the data? Then the terrain fills the view.
bool filled(const lod::Terrain& terrain, const lod::View& view) {
    const int width = view.camera().width;
    const int height = view.camera().height;
    for (int i = 0; i <= 12; ++i) {
        for (int k = 0; k <= 12; ++k) {
            if (!lod::pick(terrain, view.eye(), view.ray({width * i / 12.0, height * k / 12.0})))
                return false;
        }
    }
    return true;
}

// Cracks, T-vertices, culling that takes too much: all of them let the background shine through.
TEST(Holes, NoBackgroundShinesThrough) {
    const auto frame = geographic_frame(257, 257);
    Studio studio(make_terrain(frame, make_heights(frame, mountains)));
    constexpr unsigned kSeed = 7;
    std::mt19937 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    int views = 0;
    for (int tries = 0; views < 60 && tries < 1000; ++tries) {
        lod::Camera camera = above_looking_down(studio.terrain(), std::round(any(40, 216)),
                                                std::round(any(40, 216)), std::exp(any(0.7, 8)), 160, 120);
        camera.heading.value = any(0, 360);
        camera.pitch.value = any(-90, -20);
        camera.roll.value = any(-30, 30);
        camera.fov.value = any(5, 80);
        if (!filled(studio.terrain(), lod::View(camera))) continue;
        viewer::ViewState how;
        how.tau_px = std::exp(any(std::log(0.5), std::log(60)));
        how.morph = views % 2 == 0;
        const auto picture = studio.draw(camera, {.background = kMagenta}, how, views % 3 == 0 ? 4 : 1);
        ++views;
        int holes = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                // With several samples a pixel, one that is missing shows as a tinge: the ground has no more
                // red and blue than green.
                const auto pixel = picture.at(x, y);
                holes += pixel[0] > pixel[1] + 40 && pixel[2] > pixel[1] + 40;
            }
        }
        EXPECT_EQ(holes, 0) << "view " << views << ", seed " << kSeed << ", tau " << how.tau_px;
    }
    EXPECT_EQ(views, 60);
}

}  // namespace
}  // namespace relevo::test
