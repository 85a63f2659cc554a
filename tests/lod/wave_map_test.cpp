#include "lod/ocean/wave_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/ocean/wind_sea.hpp"

namespace relevo {
namespace {

using geo::Degrees;
using lod::WaveMap;

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr int kSide = 64;
constexpr double kTile = 128;

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

glm::dvec2 random_place(std::mt19937_64& random, double size_m) {
    const double x = uniform(random) * size_m;
    return {x, uniform(random) * size_m};
}

/// A sea of whole waves a tile, 2 to 10 of them along each axis. \param at  a tile to 1
double sea_height(const glm::dvec2& at) {
    std::mt19937_64 random(3);
    double sum = 0;
    for (int wave = 0; wave < 40; ++wave) {
        const double east = 2 + std::floor(9 * uniform(random));
        const double north = 2 + std::floor(9 * uniform(random));
        const double phase = kTwoPi * uniform(random);
        sum += 3 / std::hypot(east, north) * std::cos(kTwoPi * (east * at.x + north * at.y) + phase);
    }
    return sum;
}

std::vector<float> sea_heights() {
    std::vector<float> heights;
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            heights.push_back(
                static_cast<float>(sea_height((glm::dvec2(column, row) + 0.5) / double{kSide})));
        }
    }
    return heights;
}

/// A wave along the columns, so many a tile, crest at (0, 0) of the tile.
std::vector<float> wave_heights(double waves) {
    std::vector<float> heights;
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            heights.push_back(static_cast<float>(std::cos(kTwoPi * waves * (column + 0.5) / kSide)));
        }
    }
    return heights;
}

double deviation(const std::vector<float>& heights) {
    double squares = 0;
    for (const float h : heights) squares += static_cast<double>(h) * static_cast<double>(h);
    return std::sqrt(squares / static_cast<double>(heights.size()));
}

TEST(WaveMap, OfAFlatSeaIsFlatWhateverItsLevel) {
    const WaveMap map(8, std::vector<float>(64, 12.5F), 100, Degrees{});
    for (const double spacing : {0.0, 10.0, 1e4}) EXPECT_NEAR(map.height({12, -345}, 67, spacing), 0, 1e-6);
    EXPECT_NEAR(map.crest_m(), 0, 1e-6);
    EXPECT_EQ(WaveMap(1, {3.0F}, 10, Degrees{}).height({1, 2}, 3, 4), 0);
}

TEST(WaveMap, IsTheSumOfItsTwoCopies) {
    const auto heights = sea_heights();
    const WaveMap map(kSide, heights, kTile, Degrees{300});
    const auto& [first, second] = map.copies();
    EXPECT_NEAR(second.tile_m / first.tile_m, 3.7, 1e-12);
    const double turn = Degrees{37}.radians();
    std::mt19937_64 random(4);
    double worst = 0;
    for (int k = 0; k < 5000; ++k) {
        const glm::dvec2 at = random_place(random, 1e6);
        const double time = 1000.0 * k;
        const glm::dvec2 p = (at - first.velocity_m_s * time) / kTile;
        const glm::dvec2 q = (at - second.velocity_m_s * time) / (3.7 * kTile);
        const glm::dvec2 turned(std::cos(turn) * q.x + std::sin(turn) * q.y,
                                std::cos(turn) * q.y - std::sin(turn) * q.x);
        const double truth = (sea_height(p) + sea_height(turned)) / std::numbers::sqrt2;
        worst = std::max(worst, std::abs(map.height(at, time) - truth));
    }
    EXPECT_LT(worst, 0.02 * deviation(heights));
}

TEST(WaveMap, InterpolatesAWaveClosely) {
    // Along the line where the second copy stands still a wave along the columns is one of the first copy
    // alone.
    for (const auto& [waves, most] : {std::pair{4.0, 2e-4}, {8.0, 3e-3}, {16.0, 0.06}}) {
        const WaveMap map(kSide, wave_heights(waves), kTile, Degrees{});
        const auto& turn = map.copies()[1].turn;
        double worst = 0;
        for (double s = 0; s < 300; s += 0.173) {
            const glm::dvec2 place = s * glm::dvec2(-turn.y, turn.x);  // its column is 0: a crest
            const double truth = (std::cos(kTwoPi * waves * place.x / kTile) + 1) / std::numbers::sqrt2;
            worst = std::max(worst, std::abs(map.height(place, 0) - truth) * std::numbers::sqrt2);
        }
        EXPECT_LT(worst, most);
    }
}

TEST(WaveMap, KeepsItsVariance) {
    const auto heights = sea_heights();
    const WaveMap map(kSide, heights, kTile, Degrees{200});
    std::mt19937_64 random(5);
    constexpr int kSamples = 100000;
    double sum = 0;
    double squares = 0;
    double most = 0;
    for (int k = 0; k < kSamples; ++k) {
        const double h = map.height(random_place(random, 1e5), 0.1 * k);
        sum += h;
        squares += h * h;
        most = std::max(most, std::abs(h));
    }
    EXPECT_NEAR(std::sqrt(squares / kSamples) / deviation(heights), 1, 0.02);
    EXPECT_NEAR(sum / kSamples / deviation(heights), 0, 0.02);
    EXPECT_LE(most, map.crest_m());
    const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
    EXPECT_LT(map.crest_m(), 1.2 * std::numbers::sqrt2 * static_cast<double>(std::max(-*lowest, *highest)));
}

TEST(WaveMap, IsNotTheSameATileOn) {
    const WaveMap map(kSide, sea_heights(), kTile, Degrees{200});
    for (const glm::dvec2 shift :
         {glm::dvec2(kTile, 0), glm::dvec2(0, kTile), glm::dvec2(5 * kTile, 3 * kTile)}) {
        std::mt19937_64 random(6);
        double product = 0;
        double squares = 0;
        for (int k = 0; k < 50000; ++k) {
            const glm::dvec2 at = random_place(random, 1e5);
            const double h = map.height(at, 0);
            product += h * map.height(at + shift, 0);
            squares += h * h;
        }
        EXPECT_LT(product / squares, 0.75);
    }
}

TEST(WaveMap, DriftsWithTheWindAtItsWavesSpeed) {
    const WaveMap map(kSide, wave_heights(4), kTile, Degrees{270});
    EXPECT_NEAR(map.mean_length_m() / (kTile / 4), 1, 1e-3);
    for (const auto& copy : map.copies()) {
        const double length = map.mean_length_m() * copy.tile_m / kTile;
        EXPECT_GT(copy.velocity_m_s.x, 0) << "from the west to the east";
        EXPECT_NEAR(copy.velocity_m_s.y, 0, 1e-12);
        EXPECT_NEAR(glm::length(copy.velocity_m_s), std::sqrt(lod::kGravity * length / kTwoPi), 1e-12);
    }
    // The wave of the first copy, at places that follow its crest; the second's crest followed aside.
    const auto& [first, second] = map.copies();
    const glm::dvec2 along_crest(-second.turn.y, second.turn.x);
    for (const double time : {0.0, 10.0, 3600.0}) {
        // Place where both copies have the crest that they had at (0, 0): on the second's, as far as the
        // first has come.
        const double s =
            glm::dot(first.velocity_m_s - second.velocity_m_s, glm::dvec2(1, 0)) * time / along_crest.x;
        const glm::dvec2 at = second.velocity_m_s * time + s * along_crest;
        EXPECT_NEAR(map.height(at, time), std::numbers::sqrt2, 1e-3) << time;
    }
}

TEST(WaveMap, FadesWithTheSpacing) {
    const auto heights = sea_heights();
    const WaveMap map(kSide, heights, kTile, Degrees{20});
    const auto deviation_at = [&](double spacing) {
        std::mt19937_64 random(8);
        double squares = 0;
        for (int k = 0; k < 5000; ++k)
            squares += std::pow(map.height(random_place(random, 1e4), 1, spacing), 2);
        return std::sqrt(squares / 5000);
    };
    const double all = deviation_at(0);
    EXPECT_EQ(deviation_at(0.5 * kTile / kSide), all) << "4 vertices to 2 posts";
    double before = all;
    for (double spacing = 1; spacing < 600; spacing *= 1.2) {
        const double now = deviation_at(spacing);
        EXPECT_LE(now, before * 1.0001) << spacing;
        before = now;
    }
    EXPECT_EQ(deviation_at(1e6), 0);
    for (double spacing = 0.5; spacing < 500; spacing *= 1.01) {
        EXPECT_NEAR(map.height({77, 88}, 9, spacing), map.height({77, 88}, 9, spacing * 1.0001), 1e-3 * all);
    }
}

TEST(WaveMap, FeelsTheGround) {
    const WaveMap map(kSide, sea_heights(), kTile, Degrees{20});
    for (const auto& copy : map.copies())
        EXPECT_NEAR(copy.length_m / map.mean_length_m(), copy.tile_m / kTile, 1e-12);
    const double longest = map.copies()[1].length_m;
    const glm::dvec2 at(12, 34);
    EXPECT_EQ(map.height(at, 5, 0, 0), 0) << "on dry land";
    EXPECT_EQ(map.height(at, 5, 0, 0.5 * longest), map.height(at, 5)) << "deep";
    EXPECT_NE(map.height(at, 5, 0, 0.2 * longest), map.height(at, 5));
}

TEST(WaveMap, RepeatsWithoutSeam) {
    const WaveMap map(kSide, sea_heights(), kTile, Degrees{20});
    for (const double spacing : {0.0, 3.0, 20.0}) {
        for (double x = -kTile; x < kTile; x += 0.4999) {
            for (const double y : {0.0, kTile}) {
                const double off =
                    map.height({x, y + 1e-7}, 0, spacing) - map.height({x, y - 1e-7}, 0, spacing);
                EXPECT_NEAR(off, 0, 1e-5);
                const double side =
                    map.height({y + 1e-7, x}, 0, spacing) - map.height({y - 1e-7, x}, 0, spacing);
                EXPECT_NEAR(side, 0, 1e-5);
            }
        }
    }
}

}  // namespace
}  // namespace relevo
