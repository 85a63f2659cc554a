#include "lod/ocean/wave_map_error.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "lod/ocean/sea_spacing.hpp"

namespace relevo::lod {
namespace {

constexpr double kTile = 100;

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Families of maps: swell of few waves, a rough sea down to 4 posts, one lone crest, noise from post to
/// post.
std::vector<float> heights(const std::string& family, int side) {
    std::mt19937_64 random(7);
    std::vector<double> sum(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    const auto add_waves = [&](int waves, double most) {
        for (int wave = 0; wave < waves; ++wave) {
            const double length = std::pow(most, uniform(random));  // waves a tile
            const double angle = 2 * std::numbers::pi * uniform(random);
            const double phase = 2 * std::numbers::pi * uniform(random);
            const double east = std::round(length * std::cos(angle));
            const double north = std::round(length * std::sin(angle));
            for (std::size_t i = 0; i < sum.size(); ++i) {
                const auto column = static_cast<double>(i % static_cast<std::size_t>(side));
                const auto row = static_cast<double>(i / static_cast<std::size_t>(side));
                sum[i] += std::cos(2 * std::numbers::pi * (east * column + north * row) / side + phase) /
                          std::max(std::hypot(east, north), 1.0);
            }
        }
    };
    if (family == "swell") add_waves(5, 4);
    if (family == "rough") add_waves(60, side / 4.0);
    if (family == "crest") {
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double x = static_cast<double>(i % static_cast<std::size_t>(side)) - 0.3 * side;
            const double y = static_cast<double>(i / static_cast<std::size_t>(side)) - 0.6 * side;
            sum[i] = 3 * std::exp(-(x * x + y * y) / 50);
        }
    }
    if (family == "noise") {
        for (double& h : sum) h = uniform(random);
    }
    return {sum.begin(), sum.end()};
}

/// The largest error of meshes of a spacing, of all places: lattices anywhere, turned anyhow, their cells cut
/// along a diagonal.
double brute_force(const WaveMap& map, double spacing, int meshes, int places) {
    std::mt19937_64 random(11);
    double most = 0;
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const double angle = 2 * std::numbers::pi * uniform(random);
        const glm::dvec2 east(std::cos(angle), std::sin(angle));
        const glm::dvec2 north(-east.y, east.x);
        const double time = 1e4 * uniform(random);
        for (int place = 0; place < places; ++place) {
            const glm::dvec2 corner(1e4 * uniform(random), 1e4 * uniform(random));
            const auto height = [&](double x, double y) {
                return map.height(corner + spacing * (x * east + y * north), time, spacing);
            };
            double x = uniform(random);
            double y = uniform(random);
            if (place % 4 == 0) x = y = 0.5;
            const double h00 = height(0, 0);
            const double h11 = height(1, 1);
            const double other = x > y ? height(1, 0) : height(0, 1);
            const double drawn = h00 + (h11 - h00) * std::min(x, y) + (other - h00) * std::abs(x - y);
            const double truth = map.height(corner + spacing * (x * east + y * north), time);
            most = std::max(most, std::abs(drawn - truth));
        }
    }
    return most;
}

class MapErrors : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(MapErrors, AreABoundAndNotALooseOne) {
    const auto& [family, side] = GetParam();
    const WaveMap map(side, heights(family, side), kTile, geo::Degrees{300});
    const auto start = std::chrono::steady_clock::now();
    const WaveMapError error(map);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    RecordProperty("seconds", std::to_string(took.count()));
    double before = 0;
    for (double spacing = 0.1 * kTile / side; spacing < 5 * kTile; spacing *= 1.7) {
        const double bound = error.at(spacing);
        EXPECT_GE(bound, before);
        before = bound;
        const double worst = brute_force(map, spacing, 20, 2500);
        EXPECT_LE(worst, bound) << spacing;
        // Of a lone crest the copies' seldom meet, nor are they found.
        if (std::string(family) != "crest") {
            EXPECT_GE(worst, 0.45 * bound) << spacing;
        }
    }
    EXPECT_EQ(map.height({12, 34}, 5, error.longest_m()), 0);
}

INSTANTIATE_TEST_SUITE_P(All, MapErrors,
                         testing::Combine(testing::Values("swell", "rough", "crest", "noise"),
                                          testing::Values(32, 1024)),
                         [](const auto& one) {
                             return std::string(std::get<0>(one.param)) +
                                    std::to_string(std::get<1>(one.param));
                         });

TEST(WaveMapError, OfAFlatMapIsNone) {
    const WaveMap map(4, std::vector<float>(16, 2.0F), kTile, geo::Degrees{});
    const WaveMapError error(map);
    for (const double spacing : {0.0, 1e-3, 3.0, 1e5}) EXPECT_LE(error.at(spacing), 1e-6);
}

TEST(SeaSpacing, OfAMapKeepsToItsBound) {
    const WaveMap map(64, heights("rough", 64), kTile, geo::Degrees{300});
    const WaveMapError error(map);
    const double focal_px = 800;
    const SeaSpacing spacing([&](double s) { return error.at(s); }, error.longest_m(), focal_px, 1, 6371e3);
    double before = 0;
    // Bounds are not reached in pictures: SeaSpacing lets a mesh go a little beyond.
    for (double distance = 1; distance < 1e6; distance *= 1.3) {
        const double s = spacing.at(distance);
        EXPECT_LE(error.at(s) * focal_px / distance, 1.2) << distance;
        EXPECT_GE(s, before);
        before = s;
    }
    EXPECT_FALSE(spacing.flat_from(10));
    EXPECT_TRUE(spacing.flat_from(1.5 * focal_px * map.crest_m()));
}

}  // namespace
}  // namespace relevo::lod
