#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "geo/ellipsoid.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/camera.hpp"
#include "viewer/offscreen.hpp"

namespace relevo::test {
namespace {

using viewer::ViewState;

class HardViews : public testing::Test {
  protected:
    HardViews()
        : terrain_(make_terrain(
              geographic_frame(129, 129),
              make_heights(geographic_frame(129, 129), [](int c, int r) { return mountains(c, r) / 4; }))),
          ground_(ground_of(terrain_)),
          heights_(nullptr) {}

    ViewState at(double metres_above_ground) const {
        ViewState view;
        viewer::set_eye(view, heights_, above(terrain_, 64, 64, metres_above_ground));
        return view;
    }

    viewer::FinishedPicture draw(const ViewState& view, viewer::PictureRequest request = {}) const {
        if (request.width == 1280) request.width = 96, request.height = 64;
        return must(viewer::draw_picture(terrain_, ground_, heights_, view, request));
    }

    static bool bluish(const std::array<int, 3>& pixel) { return pixel[2] > pixel[1] && pixel[1] > pixel[0]; }

    lod::Terrain terrain_;
    viewer::GroundData ground_;
    viewer::EyeHeight heights_;
};

TEST_F(HardViews, StraightUpIsSkyAndAPicture) {
    ViewState view = at(10);
    view.pitch.value = 90;
    const auto made = draw(view, {.measure_error = true});
    EXPECT_FALSE(made.figures.error);
    for (int x = 0; x < made.picture.width; x += 5)
        EXPECT_TRUE(bluish(made.picture.at(x, x % made.picture.height)));
}

TEST_F(HardViews, OnePixel) {
    ViewState view = at(500);
    view.pitch.value = -90;
    const auto made = draw(view, {.width = 1, .height = 1, .samples = 8});
    ASSERT_EQ(made.picture.rgb.size(), 3u);
    EXPECT_GT(made.picture.at(0, 0)[1], 20);
    EXPECT_FALSE(bluish(made.picture.at(0, 0)));
}

TEST_F(HardViews, VeryNarrowAndVeryWide) {
    for (const double fov : {1.0, 150.0, 179.0}) {
        ViewState view = at(300);
        view.pitch.value = -40;
        view.fov.value = fov;
        const auto made = draw(view, {.measure_error = true});
        EXPECT_GT(made.figures.triangles, 0u) << fov;
        ASSERT_TRUE(made.figures.error) << fov;
        EXPECT_LE(made.figures.error->max_px, view.tau_px) << fov;
        const auto bottom = made.picture.at(48, 50);
        EXPECT_FALSE(bluish(bottom)) << fov;
    }
}

TEST_F(HardViews, UnderTheGround) {
    ViewState view = at(-50);
    view.pitch.value = 60;
    const auto made = draw(view);
    EXPECT_GT(made.figures.triangles, 0u);
    // The underside of the ground, dark, where from above there is sky.
    EXPECT_LT(made.picture.at(48, 32)[2], 100);
}

TEST_F(HardViews, OneCentimetreAboveTheGround) {
    ViewState view = at(0.01);
    view.pitch.value = -30;
    const auto made = draw(view, {.measure_error = true});
    ASSERT_TRUE(made.figures.error);
    EXPECT_LE(made.figures.error->max_px, view.tau_px);
}

// The limb of the earth: seen from h above it is asin(R / (R + h)) from straight down.
TEST_F(HardViews, TenThousandKilometresUp) {
    ViewState view = at(0);
    view.H.m = 10e6;
    view.pitch.value = -90;
    view.fov.value = 60;
    const auto made = draw(view, {.width = 400, .height = 400, .samples = 1});
    const double limb = std::asin(6370e3 / (6370e3 + 10e6));  // the mean radius at 36 degrees is near this
    const double radius_px = 200 / std::tan(geo::Degrees{30}.radians()) * std::tan(limb);
    const auto is_space = [](const std::array<int, 3>& pixel) { return pixel[0] + pixel[1] + pixel[2] < 60; };
    for (const double degrees : {0.0, 45.0, 90.0, 200.0, 300.0}) {
        const double angle = geo::Degrees{degrees}.radians();
        const auto at_radius = [&](double r) {
            return made.picture.at(static_cast<int>(200 + r * std::cos(angle)),
                                   static_cast<int>(200 + r * std::sin(angle)));
        };
        EXPECT_FALSE(is_space(at_radius(radius_px - 4))) << degrees;
        EXPECT_TRUE(is_space(at_radius(radius_px + 12))) << degrees;
    }
}

// Without ground in view, the horizon is the ellipsoid's: acos(R / (R + h)) below level.
TEST_F(HardViews, HorizonIsWhereTheEarthEnds) {
    for (const double metres : {2.0, 2000.0, 100e3}) {
        ViewState view;
        view.place = {geo::Degrees{0},
                      geo::Degrees{0}};  // far from the data, looking north along the equator's R
        view.H.m = metres;
        view.heading.value = 90;
        view.fov.value = 4;
        const double dip = std::acos(geo::wgs84::kSemiMajor / (geo::wgs84::kSemiMajor + metres));
        view.pitch = geo::Degrees::from_radians(-dip);
        const auto made = draw(view, {.width = 33, .height = 400, .samples = 1});
        // Sky is bluer than the ground; the change comes within a pixel of the middle.
        const auto blueness = [&](int y) { return made.picture.at(16, y)[2] - made.picture.at(16, y)[0]; };
        int edge = 0;
        int steepest = 0;
        for (int y = 100; y < 300; ++y) {
            const int change = std::abs(blueness(y) - blueness(y + 1)) +
                               std::abs(made.picture.at(16, y)[0] - made.picture.at(16, y + 1)[0]);
            if (change > steepest) steepest = change, edge = y;
        }
        EXPECT_NEAR(edge, 199.5, 2) << metres << " m up";
    }
}

TEST_F(HardViews, OutsideTheScene) {
    ViewState view = at(3000);
    view.place.lon.value += 40;
    view.pitch.value = -20;
    const auto made = draw(view, {.measure_error = true});
    EXPECT_FALSE(made.figures.error);
}

// Large pictures are drawn in tiles: the seams must not show.
TEST_F(HardViews, TilesJoin) {
    ViewState view = at(800);
    view.pitch.value = -20;
    const auto large = draw(view, {.width = 2600, .height = 2100, .samples = 4});
    EXPECT_EQ(large.figures.draw_calls, 8);
    const int x = 2048;
    int seam = 0;
    int beside = 0;
    for (int y = 0; y < 2100; ++y) {
        for (std::size_t i = 0; i < 3; ++i) {
            seam += std::abs(large.picture.at(x - 1, y)[i] - large.picture.at(x, y)[i]);
            beside += std::abs(large.picture.at(x + 5, y)[i] - large.picture.at(x + 6, y)[i]);
        }
    }
    EXPECT_LT(seam, 2 * beside + 2100);
}

TEST_F(HardViews, LookingOverShowsEveryCorner) {
    lod::SceneInfo info;
    info.height_min_m = 0;
    info.height_max_m = 1000;
    for (const auto& [width, height] : {std::pair(1280, 720), std::pair(300, 900)}) {
        ViewState view;
        viewer::look_over(view, terrain_, info, heights_, width, height);
        EXPECT_NEAR(view.pitch.value, -30, 1);
        EXPECT_NEAR(geo::wrapped_180(view.heading).value, 0, 0.1);
        const lod::View seen(viewer::camera_of(view, heights_, width, height));
        int near_edge = 0;
        for (const double column : {0.0, 128.0}) {
            for (const double row : {0.0, 128.0}) {
                for (const double h : {info.height_min_m, info.height_max_m}) {
                    const auto offset = terrain_.frame().ecef({column, row}, {h}) - seen.eye();
                    EXPECT_TRUE(seen.sees(offset));
                    const auto pixel = seen.pixel(offset);
                    near_edge += std::min({pixel.x / width, 1 - pixel.x / width, pixel.y / height,
                                           1 - pixel.y / height}) < 0.03;
                }
            }
        }
        EXPECT_GT(near_edge, 0) << "too far away";
    }
}

}  // namespace
}  // namespace relevo::test
