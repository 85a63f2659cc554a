#include "lod/ocean/wave_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relevo {
namespace {

using geo::Degrees;
using lod::Waves;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// What a mesh of this spacing carries.
Waves faded(const Waves& waves, double spacing) {
    auto components = waves.components();
    for (auto& c : components) c.amplitude_m *= lod::sampled_part(c.length_m() / spacing);
    return Waves(components);
}

/// The largest error seen of a mesh on a lattice through (0, 0), turned by an angle: at random places each
/// square's triangle is found and the heights of its corners interpolated.
double worst_error(const Waves& waves, double spacing, double turn, int samples, std::mt19937_64& random) {
    const Waves drawn = faded(waves, spacing);
    const glm::dvec2 east = spacing * glm::dvec2(std::cos(turn), std::sin(turn));
    const glm::dvec2 north(-east.y, east.x);
    double worst = 0;
    for (int k = 0; k < samples; ++k) {
        const glm::dvec2 corner =
            std::floor(1e4 * uniform(random)) * east + std::floor(1e4 * uniform(random)) * north;
        double s = uniform(random);
        double t = uniform(random);
        const double time = 0;
        const double full = waves.height(corner + s * east + t * north, time);
        glm::dvec2 right_angle = corner;
        glm::dvec2 x = east;
        glm::dvec2 y = north;
        if (s + t > 1) {
            right_angle += east + north;
            x = -east;
            y = -north;
            s = 1 - s;
            t = 1 - t;
        }
        const double flat = (1 - s - t) * drawn.height(right_angle, time) +
                            s * drawn.height(right_angle + x, time) + t * drawn.height(right_angle + y, time);
        worst = std::max(worst, std::abs(flat - full));
    }
    return worst;
}

/// The same along a line of vertices.
double worst_error_on_line(const Waves& waves, double spacing, int samples, std::mt19937_64& random) {
    const Waves drawn = faded(waves, spacing);
    double worst = 0;
    for (int k = 0; k < samples; ++k) {
        const glm::dvec2 a(std::floor(1e5 * uniform(random)) * spacing, 0);
        const glm::dvec2 b = a + glm::dvec2(spacing, 0);
        const double t = uniform(random);
        const double flat = (1 - t) * drawn.height(a, 0) + t * drawn.height(b, 0);
        worst = std::max(worst, std::abs(flat - waves.height((1 - t) * a + t * b, 0)));
    }
    return worst;
}

Waves single(double length, double azimuth, double phase) {
    const double k = 2 * std::numbers::pi / length;
    return Waves({{k * glm::dvec2(std::sin(azimuth), std::cos(azimuth)), 1, 1, phase}});
}

TEST(WaveError, FadesSmoothly) {
    EXPECT_EQ(lod::sampled_part(0), 0);
    EXPECT_EQ(lod::sampled_part(lod::kFadeFrom), 0);
    EXPECT_NEAR(lod::sampled_part(0.5 * (lod::kFadeFrom + lod::kFadeTo)), 0.5, 1e-12);
    EXPECT_EQ(lod::sampled_part(lod::kFadeTo), 1);
    EXPECT_EQ(lod::sampled_part(kInfinity), 1);
    EXPECT_EQ(lod::interpolation_error(0), 2);
    EXPECT_EQ(lod::interpolation_error(std::numbers::sqrt2), 2);
    EXPECT_NEAR(lod::interpolation_error(2 * std::numbers::sqrt2), 1, 1e-15);
    EXPECT_EQ(lod::interpolation_error(kInfinity), 0);
    // A smoothstep is steepest in its middle: 1.5 over its width.
    const double steepest = 1.51 / (lod::kFadeTo - lod::kFadeFrom);
    for (double n = 0.5; n < 12; n += 0.001) {
        ASSERT_NEAR(lod::sampled_part(n), lod::sampled_part(n + 0.001), 0.001 * steepest) << n;
        ASSERT_NEAR(lod::interpolation_error(n), lod::interpolation_error(n + 0.001), 0.0025) << n;
        ASSERT_GE(lod::interpolation_error(n), lod::interpolation_error(n + 0.001)) << n;
    }
}

TEST(WaveError, OfOneWaveIsBoundedAndTheBoundIsMet) {
    std::mt19937_64 random(1);
    for (const double n : {2.0, 3.2, 4.0, 5.0, 6.0, 9.0, 20.0}) {
        double worst = 0;
        for (int trial = 0; trial < 30; ++trial) {
            // The first ones run along the diagonal that is an edge.
            const double azimuth = trial < 10 ? -std::numbers::pi / 4 : 7 * uniform(random);
            const Waves wave = single(n, azimuth, 7 * uniform(random));
            worst = std::max(worst, worst_error(wave, 1, 0, 20000, random));
        }
        const double bound = lod::mesh_error_m(single(n, 0, 0), 1);
        EXPECT_LE(worst, bound * (1 + 1e-9)) << n;
        EXPECT_GT(worst, 0.9 * bound) << n;
    }
}

TEST(WaveError, OfAWindsWavesIsBoundedAndNotFarBelow) {
    std::mt19937_64 random(2);
    for (const double u : {3.0, 10.0, 25.0}) {
        const Waves waves = Waves::of_wind({u, Degrees{250}}, static_cast<std::uint64_t>(u));
        for (double spacing = 0.05; spacing < 300; spacing *= 3.3) {
            const double bound = lod::mesh_error_m(waves, spacing);
            // The bound is for a lattice of any direction.
            double worst = 0;
            for (int turn = 0; turn < 12; ++turn) {
                worst = std::max(worst, worst_error(waves, spacing, 0.13 * turn, 3000, random));
            }
            EXPECT_LE(worst, bound) << u << ' ' << spacing;
            EXPECT_LT(bound, 3 * worst) << u << ' ' << spacing;
            EXPECT_LE(worst_error_on_line(waves, spacing, 5000, random), bound) << u << ' ' << spacing;
        }
    }
}

TEST(WaveError, NeverFallsAsTheSpacingGrows) {
    const Waves waves = Waves::of_wind({10, Degrees{250}});
    double before = 0;
    for (double spacing = 1e-3; spacing < 1e3; spacing *= 1.003) {
        const double error = lod::mesh_error_m(waves, spacing);
        EXPECT_GE(error, before * (1 - 1e-12)) << spacing;
        EXPECT_LE(error, waves.crest_m() * (1 + 1e-12));
        before = error;
    }
    EXPECT_EQ(lod::mesh_error_m(waves, 0), 0);
    EXPECT_EQ(lod::mesh_error_m(Waves(), 1), 0);
}

}  // namespace
}  // namespace relevo
