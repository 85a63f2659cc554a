#include <gtest/gtest.h>

#include "lod/soar/pick.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

/// Compares a picture with rays through its pixels' middles: pixels with ground are those whose ray hits the
/// full data, but for pixels next to the edge between the two. Gives back how many pixels have ground.
int expect_drawn_where_rays_hit(Studio& studio, const lod::Camera& camera, double tau_px) {
    viewer::ViewState how;
    how.tau_px = tau_px;
    const auto picture = studio.draw(camera, {.background = kMagenta}, how);
    const lod::View view(camera);
    const auto hit = [&](double x, double y) {
        return lod::pick(studio.terrain(), view.eye(), view.ray({x, y})).has_value();
    };
    // A drawn edge may be off by tau, and by rounding a little more.
    const double reach = tau_px + 0.1;
    int drawn = 0;
    int wrong = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const bool ground = !is_magenta(picture.at(x, y));
            drawn += ground;
            const double middle_x = x + 0.5;
            const double middle_y = y + 0.5;
            if (ground == hit(middle_x, middle_y)) continue;
            const bool at_edge =
                ground == hit(middle_x - reach, middle_y) || ground == hit(middle_x + reach, middle_y) ||
                ground == hit(middle_x, middle_y - reach) || ground == hit(middle_x, middle_y + reach);
            wrong += !at_edge;
        }
    }
    EXPECT_EQ(wrong, 0);
    return drawn;
}

TEST(Voids, AreNotDrawnAndTheirEdgesAreInTheRightPixel) {
    // 100 x 70 posts: padding to the east and to the south; one void post, a block, a line to the edge.
    const auto frame = geographic_frame(100, 70);
    Studio studio(make_terrain(frame, make_heights(frame, [](int column, int row) {
                                   const bool alone = column == 50 && row == 30;
                                   const bool block = column >= 20 && column < 32 && row >= 40 && row < 45;
                                   const bool line = row == 10 && column >= 80;
                                   return alone || block || line ? static_cast<double>(kVoid)
                                                                 : mountains(column, row) / 8;
                               })));
    const int pixels = 120 * 90;
    for (const double tau : {0.5, 3.0}) {
        for (const auto& [column, row, metres] :
             {std::tuple(50.0, 29.0, 400.0), std::tuple(26.0, 38.0, 900.0), std::tuple(95.0, 12.0, 1200.0),
              std::tuple(98.0, 68.0, 1500.0), std::tuple(1.0, 1.0, 1500.0)}) {
            auto camera = above_looking_down(studio.terrain(), column, row, metres, 120, 90);
            const int drawn = expect_drawn_where_rays_hit(studio, camera, tau);
            EXPECT_GT(drawn, pixels / 8);
            EXPECT_LT(drawn, pixels);
            camera.pitch.value = -50;
            camera.heading.value = 130;
            expect_drawn_where_rays_hit(studio, camera, tau);
        }
    }
}

TEST(Voids, AllVoidDrawsNothing) {
    const auto frame = geographic_frame(20, 20);
    Studio studio(
        make_terrain(frame, make_heights(frame, [](int, int) { return static_cast<double>(kVoid); })));
    lod::Camera camera = above_looking_down(studio.terrain(), 10, 10, 0);
    camera.eye.h.m = 1000;
    EXPECT_EQ(expect_drawn_where_rays_hit(studio, camera, 1), 0);
    EXPECT_FALSE(studio.figures.ground_seen);
}

}  // namespace
}  // namespace relevo::test
