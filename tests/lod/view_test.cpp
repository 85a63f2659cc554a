#include "lod/view.hpp"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relevo {
namespace {

using geo::Degrees;

lod::Camera camera(double heading, double pitch, double roll = 0) {
    lod::Camera camera;
    camera.eye = {Degrees{45}, Degrees{7}, {1000}};
    camera.heading = Degrees{heading};
    camera.pitch = Degrees{pitch};
    camera.roll = Degrees{roll};
    return camera;
}

TEST(View, LooksWhereHeadingAndPitchSay) {
    const geo::EnuFrame local(camera(0, 0).eye);
    EXPECT_NEAR(glm::distance(lod::View(camera(0, 0)).forward(), local.north()), 0, 1e-15);
    EXPECT_NEAR(glm::distance(lod::View(camera(90, 0)).forward(), local.east()), 0, 1e-15);
    EXPECT_NEAR(glm::distance(lod::View(camera(0, -90)).forward(), -local.up()), 0, 1e-15);
    EXPECT_NEAR(glm::distance(lod::View(camera(0, -90)).up(), local.north()), 0, 1e-15) << "heading is up";
    EXPECT_NEAR(glm::distance(lod::View(camera(180, 90)).forward(), local.up()), 0, 1e-15);
}

TEST(View, RollToTheRightLiftsTheRightEndOfTheHorizon) {
    const lod::View view(camera(0, 0, 10));
    const geo::EnuFrame local(view.camera().eye);
    const glm::dvec3 right_end = 1000.0 * local.north() + 300.0 * local.east();
    const glm::dvec3 left_end = 1000.0 * local.north() - 300.0 * local.east();
    EXPECT_LT(view.pixel(right_end).y, view.pixel(left_end).y) << "y runs down";
}

TEST(View, PixelAndRayAreInverse) {
    const lod::View view(camera(33, -20, 5));
    for (const glm::dvec2 pixel : {glm::dvec2(0, 0), glm::dvec2(640, 360), glm::dvec2(1279.5, 0.5)}) {
        EXPECT_NEAR(glm::distance(view.pixel(1234.0 * view.ray(pixel)), pixel), 0, 1e-9);
    }
    EXPECT_NEAR(glm::distance(view.ray({640, 360}), view.forward()), 0, 1e-15);
}

TEST(View, SeesWhatLiesBetweenItsSidePlanes) {
    const lod::View view(camera(200, -40));
    EXPECT_TRUE(view.sees(view.ray({0.01, 0.01})));
    EXPECT_TRUE(view.sees(view.ray({1279.99, 719.99})));
    EXPECT_FALSE(view.sees(view.ray({-0.01, 360})));
    EXPECT_FALSE(view.sees(view.ray({1280.01, 360})));
    EXPECT_FALSE(view.sees(view.ray({640, -0.01})));
    EXPECT_FALSE(view.sees(view.ray({640, 720.01})));
    EXPECT_FALSE(view.sees(-view.forward()));
    EXPECT_FALSE(view.sees(0.0001 * view.forward())) << "before the near plane";
}

// The projection matrix is OpenGL's: its result must land on the pixel that View::pixel computes in double.
TEST(View, ProjectionAgreesWithPixel) {
    const lod::View view(camera(33, -20, 5));
    const glm::mat4 projection = view.projection();
    for (const glm::dvec2 pixel : {glm::dvec2(10, 20), glm::dvec2(900, 700)}) {
        const glm::vec3 eye_space(view.to_eye_space() * (5000.0 * view.ray(pixel)));
        const glm::vec4 clip = projection * glm::vec4(eye_space, 1);
        EXPECT_NEAR(static_cast<double>(clip.x / clip.w), 2 * pixel.x / 1280 - 1, 1e-6);
        EXPECT_NEAR(static_cast<double>(clip.y / clip.w), 1 - 2 * pixel.y / 720, 1e-6);
    }
}

// Reversed depth: 1 at the near plane, 0 at infinity, and neighbours stay apart (DESIGN: 2 cm at 10 km, 10 cm
// at 100 km).
TEST(View, ReversedDepthKeepsNeighboursApart) {
    const glm::mat4 projection = lod::View(camera(0, 0)).projection();
    const auto depth = [&](double z) {
        const glm::vec4 clip = projection * glm::vec4(0, 0, -static_cast<float>(z), 1);
        return clip.z / clip.w;
    };
    EXPECT_FLOAT_EQ(depth(lod::View::kNearM), 1);
    EXPECT_GT(depth(10000), depth(10000.02));
    EXPECT_GT(depth(100000), depth(100000.1));
    EXPECT_GT(depth(1e9), 0);
}

// Definition: of a point at distance D and one delta from it, either of them in the picture, the other
// appears at most lambda delta / (D - kappa delta) away. Also where it is far out of the picture.
TEST(View, ErrorScaleBoundsEveryDisplacementInThePicture) {
    for (const double fov : {1.0, 60.0, 150.0}) {
        lod::Camera wide = camera(0, 0);
        wide.fov = Degrees{fov};
        const lod::View view(wide);
        const auto scale = view.error_scale();
        double tightest = 0;
        for (int k = 0; k < 60000; ++k) {
            const glm::dvec2 pixel(std::fmod(k * 97.3, 1280), std::fmod(k * 31.7, 720));
            const double away = 10 + k % 100;
            const glm::dvec3 seen = away * view.ray(pixel);
            const double a = k * 0.7;
            const double b = k * 1.3;
            const double delta = std::array{1e-3, 0.05, 0.3}.at(static_cast<std::size_t>(k % 3)) * away;
            const glm::dvec3 other =
                seen + delta * glm::dvec3(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
            for (const double distance : {away, glm::length(other)}) {  // either may be the true point
                if (distance <= scale.kappa * delta) continue;
                const double bound = scale.lambda_px * delta / (distance - scale.kappa * delta);
                ASSERT_GT(view.depth(other), 0);
                const double measured = glm::distance(view.pixel(other), pixel);
                ASSERT_LE(measured, bound) << "fov " << fov << " pixel " << pixel.x << ' ' << pixel.y;
                tightest = std::max(tightest, measured / bound);
            }
        }
        EXPECT_GT(tightest, 0.5) << "the bound is not wasteful at the corners, fov " << fov;
    }
}

}  // namespace
}  // namespace relevo
