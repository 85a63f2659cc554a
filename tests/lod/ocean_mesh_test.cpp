#include "lod/ocean/ocean_mesh.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relevo::lod {
namespace {

TEST(OceanPatch, CellsTurnCounterClockwiseFromAbove) {
    const OceanPatch patch = cells_patch(3, 2);
    EXPECT_EQ(patch.vertices.size(), 12U);
    EXPECT_EQ(patch.triangles(), 12U);
    for (std::size_t t = 0; t < patch.indices.size(); t += 3) {
        const glm::ivec2 a(patch.vertices[patch.indices[t]]), b(patch.vertices[patch.indices[t + 1]]),
            c(patch.vertices[patch.indices[t + 2]]);
        const glm::ivec2 u = b - a, v = c - a;
        EXPECT_EQ(u.x * v.y - u.y * v.x, 1);
    }
}

// A block was left out whose places were in the picture: the chart's metres are not quite the earth's.
TEST(PatchInView, IsTrueOfEveryPlaceThatIsSeen) {
    constexpr unsigned kSeed = 5;
    std::mt19937_64 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    constexpr double kCrest = 4;
    int seen = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const double height = std::exp(any(std::log(2.0), std::log(3e6)));
        const Camera camera{
            .eye = {geo::Degrees{any(-80, 80)}, geo::Degrees{any(-180, 180)}, geo::EllipsoidalHeight{height}},
            .heading = geo::Degrees{any(0, 360)},
            .pitch = geo::Degrees{any(-90, 5)},
            .roll = geo::Degrees{any(-30, 30)},
            .fov = geo::Degrees{any(5, 120)}};
        const View view(camera);
        // As far from the eye as anchors are.
        const SeaChart chart({geo::Degrees{camera.eye.lat.value + any(-5, 5)},
                              geo::Degrees{camera.eye.lon.value + any(-5, 5)}});
        const SeaView sea(view, chart, 0, kCrest);
        for (int k = 0; k < 500; ++k) {
            const double away = sea.reach_m * std::exp(any(-8, 0));
            const double angle = any(0, 2 * std::numbers::pi);
            const glm::dvec2 at = away * glm::dvec2(std::cos(angle), std::sin(angle));
            const geo::LatLon place = chart.place(sea.nadir + at);
            const double h = any(-kCrest, kCrest);
            const glm::dvec3 offset =
                geo::to_ecef({place.lat, place.lon, geo::EllipsoidalHeight{h}}) - view.eye();
            if (!view.sees(offset)) continue;
            ++seen;
            const double half = away * std::exp(any(-6, -1));
            const glm::dvec2 inside(any(-half, half), any(-half, half));
            const glm::dvec2 middle = at + inside;
            const std::array<glm::dvec2, 4> corners{
                middle + glm::dvec2(-half, -half), middle + glm::dvec2(half, -half),
                middle + glm::dvec2(half, half), middle + glm::dvec2(-half, half)};
            ASSERT_TRUE(patch_in_view(sea, corners)) << height << " m, " << away << " m away, seed " << kSeed;
        }
    }
    EXPECT_GT(seen, 5000);
}

TEST(PatchInView, IsFalseBehindTheEyeAndBehindTheHorizon) {
    Camera camera{};
    camera.eye = {geo::Degrees{43}, geo::Degrees{7}, geo::EllipsoidalHeight{50}};
    camera.heading = geo::Degrees{90};
    const View view(camera);
    const SeaChart chart({geo::Degrees{43}, geo::Degrees{7}});
    const SeaView sea(view, chart, 0, 2);
    const auto square = [](double east, double side) {
        return std::array<glm::dvec2, 4>{
            {{east, -side}, {east + side, -side}, {east + side, side}, {east, side}}};
    };
    EXPECT_TRUE(patch_in_view(sea, square(1000, 100)));
    EXPECT_FALSE(patch_in_view(sea, square(-2000, 100)));
    EXPECT_FALSE(patch_in_view(sea, square(sea.reach_m + 1000, 100)));
}

}  // namespace
}  // namespace relevo::lod
