#include "lod/ocean/waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relevo {
namespace {

using geo::Degrees;
using lod::kGravity;
using lod::Waves;
using lod::WindSea;

constexpr double kTwoPi = 2 * std::numbers::pi;

glm::dvec2 random_place(std::mt19937_64& random, double size_m) {
    const auto coordinate = [&] { return (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) * size_m; };
    const double x = coordinate();
    return {x, coordinate()};
}

TEST(Waves, CarryTheEnergyOfTheSpectrum) {
    for (const double u : {1.0, 2.0, 5.0, 10.0, 20.0, 30.0}) {
        const WindSea sea({u, {}});
        const Waves waves = Waves::of_wind({u, {}}, 7);
        const auto& c = waves.components();
        ASSERT_FALSE(c.empty()) << u;
        // The bands end half a band below 1 m.
        const double longest = 2.5 * sea.peak_length_m();
        const double last = std::pow(longest, -0.5 / (static_cast<double>(c.size()) - 0.5));
        const double covered =
            4 * std::sqrt(sea.variance(lod::deep_water_rad_s(longest), lod::deep_water_rad_s(last)));
        EXPECT_NEAR(waves.significant_height_m() / covered, 1, 1e-5) << u;
        if (u >= 3) {
            EXPECT_NEAR(waves.significant_height_m() / sea.significant_height_m(), 1, 0.01) << u;
        }
    }
}

TEST(Waves, ReachFromTwiceAndAHalfThePeakDownToAMetre) {
    for (const double u : {1.0, 3.0, 10.0, 25.0}) {
        const double longest = 2.5 * WindSea({u, {}}).peak_length_m();
        const Waves waves = Waves::of_wind({u, {}}, 3);
        const auto& c = waves.components();
        ASSERT_FALSE(c.empty());
        const double band = std::pow(longest, 1 / (static_cast<double>(c.size()) - 0.5));
        for (std::size_t i = 0; i < c.size(); ++i) {
            const double upper = longest * std::pow(band, -static_cast<double>(i));
            EXPECT_LE(c[i].length_m(), upper * (1 + 1e-12));
            EXPECT_GE(c[i].length_m(), upper / band * (1 - 1e-12));
        }
        EXPECT_NEAR(longest * std::pow(band, 0.5 - static_cast<double>(c.size())), 1, 1e-9)
            << "middle of the last";
        if (u >= 3) {
            EXPECT_EQ(c.size(), static_cast<std::size_t>(Waves::kComponents)) << u;
        }
        if (u <= 1) {
            EXPECT_LT(c.size(), static_cast<std::size_t>(Waves::kComponents)) << u;
        }
    }
    for (const double u : {0.0, 0.3, 0.6, -1.0, std::nan("")}) {
        const Waves still = Waves::of_wind({u, {}});
        EXPECT_TRUE(still.components().empty()) << u;
        EXPECT_EQ(still.height({3, 4}, 5), 0);
        EXPECT_EQ(still.crest_m(), 0);
        EXPECT_EQ(still.slope_variance(), 0);
    }
}

TEST(Waves, RunAsFastAsAiryTheorySays) {
    for (const auto& c : Waves::of_wind({12, {}}).components()) {
        const double phase_speed = std::sqrt(kGravity * c.length_m() / kTwoPi);
        EXPECT_NEAR(c.omega / glm::length(c.k) / phase_speed, 1, 1e-14) << "deep water";
    }
    for (const auto& c : Waves::of_wind({12, {}}, 1, 0.01).components()) {
        EXPECT_NEAR(c.omega / glm::length(c.k) / std::sqrt(kGravity * 0.01), 1, 1e-3) << "shallow";
    }
    for (const double depth : {2.0, 10.0, 50.0}) {
        for (const auto& c : Waves::of_wind({12, {}}, 1, depth).components()) {
            const double k = glm::length(c.k);
            const double e = std::exp(-2 * k * depth);
            EXPECT_NEAR(c.omega * c.omega / (kGravity * k * (1 - e) / (1 + e)), 1, 1e-13);
        }
    }
}

TEST(Waves, RunTowardsWhereTheWindBlows) {
    for (const double from : {0.0, 90.0, 225.0, 350.0}) {
        const double towards = Degrees{from + 180}.radians();
        const glm::dvec2 along(std::sin(towards), std::cos(towards));
        glm::dvec2 flow(0);
        for (std::uint64_t seed = 1; seed <= 30; ++seed) {
            for (const auto& c : Waves::of_wind({10, Degrees{from}}, seed).components()) {
                flow += c.amplitude_m * c.amplitude_m * glm::normalize(c.k);
                // A crest moves along k: where it was, the same phase is omega / k farther a second later.
                const Waves one({c});
                const glm::dvec2 step = glm::normalize(c.k) * (c.omega / glm::length(c.k));
                EXPECT_NEAR(one.height({5, 9}, 100), one.height(glm::dvec2(5, 9) + step, 101), 1e-9);
            }
        }
        EXPECT_GT(glm::dot(glm::normalize(flow), along), std::cos(Degrees{5}.radians())) << from;
    }
}

TEST(Waves, AreTheSameForTheSameSeed) {
    const auto a = Waves::of_wind({10, Degrees{270}}, 5).components();
    const auto b = Waves::of_wind({10, Degrees{270}}, 5).components();
    const auto other = Waves::of_wind({10, Degrees{270}}, 6).components();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].k, b[i].k);
        EXPECT_EQ(a[i].amplitude_m, b[i].amplitude_m);
        EXPECT_EQ(a[i].phase, b[i].phase);
        EXPECT_NE(a[i].phase, other[i].phase);
        EXPECT_EQ(a[i].amplitude_m, other[i].amplitude_m) << "energy does not depend on chance";
    }
    // As they came out first: another machine, compiler or library must give these.
    EXPECT_NEAR(a[0].length_m(), 208.2516574802, 1e-9);
    EXPECT_NEAR(a[0].phase, 1.41552975089049, 1e-12);
    EXPECT_NEAR(a[31].length_m(), 0.9275789156781, 1e-9);
    EXPECT_NEAR(a[31].k.x, 6.657365902789, 1e-9);
    EXPECT_NEAR(Waves(a).height({100, 200}, 300), -0.4074321188395, 1e-9);
}

TEST(Waves, HeightsVaryAsTheSpectrumSays) {
    std::mt19937_64 random(11);
    for (const double u : {4.0, 10.0, 20.0}) {
        const Waves waves = Waves::of_wind({u, Degrees{30}}, 2);
        double sum = 0;
        double squares = 0;
        double most = 0;
        constexpr int kSamples = 60000;
        for (int k = 0; k < kSamples; ++k) {
            const double h = waves.height(random_place(random, 200e3), 0.37 * k);
            sum += h;
            squares += h * h;
            most = std::max(most, std::abs(h));
        }
        const double deviation = std::sqrt(squares / kSamples);
        EXPECT_NEAR(sum / kSamples / deviation, 0, 0.02) << u;
        EXPECT_NEAR(4 * deviation / WindSea({u, {}}).significant_height_m(), 1, 0.02) << u;
        EXPECT_LE(most, waves.crest_m());
        EXPECT_GT(most, 0.4 * waves.crest_m());
    }
}

TEST(Waves, SlopesVaryAsTheirVarianceSays) {
    std::mt19937_64 random(12);
    const Waves waves = Waves::of_wind({10, Degrees{30}}, 2);
    constexpr double kStep = 1e-3;
    double squares = 0;
    constexpr int kSamples = 40000;
    for (int k = 0; k < kSamples; ++k) {
        const glm::dvec2 at = random_place(random, 10e3);
        const auto slope = [&](const glm::dvec2& step) {
            return (waves.height(at + step, 0) - waves.height(at - step, 0)) / (2 * kStep);
        };
        squares += std::pow(slope({kStep, 0}), 2) + std::pow(slope({0, kStep}), 2);
    }
    EXPECT_NEAR(squares / kSamples / waves.slope_variance(), 1, 0.03);
    EXPECT_LT(waves.slope_variance(), lod::cox_munk_slope_variance(10)) << "waves below 1 m are left out";
    EXPECT_NEAR(lod::cox_munk_slope_variance(10), 0.0542, 1e-12);
}

TEST(Waves, AreRightFarAwayAndAfterLong) {
    std::mt19937_64 random(13);
    const Waves waves = Waves::of_wind({15, Degrees{300}}, 4);
    double worst = 0;
    for (int k = 0; k < 3000; ++k) {
        const glm::dvec2 at = random_place(random, 2e6);
        const double time = 3.6e6 - k;
        long double truth = 0;
        for (const auto& c : waves.components()) {
            const long double angle = static_cast<long double>(c.k.x) * at.x +
                                      static_cast<long double>(c.k.y) * at.y -
                                      static_cast<long double>(c.omega) * time + c.phase;
            truth += c.amplitude_m * std::cos(angle);
        }
        worst = std::max(worst, std::abs(waves.height(at, time) - static_cast<double>(truth)));
    }
    EXPECT_LT(worst, 1e-8);
}

TEST(Waves, FlattenOverTheGround) {
    const Waves waves = Waves::of_wind({10, Degrees{}}, 9);
    const double deep = waves.components().front().length_m() / 2;
    for (int k = 0; k < 50; ++k) {
        const glm::dvec2 at(37.0 * k, -11.0 * k);
        EXPECT_NEAR(waves.height(at, k, deep), waves.height(at, k), 1e-15);
        EXPECT_EQ(waves.height(at, k, 0), 0);
        EXPECT_EQ(waves.height(at, k, -20), 0);
        EXPECT_NEAR(waves.height(at, k, 3), waves.height(at, k, 3 + 1e-7), 1e-6);
    }
    EXPECT_EQ(lod::depth_part(5, 10), 1);
    EXPECT_EQ(lod::depth_part(2.5, 10), 0.5);
    EXPECT_EQ(lod::depth_part(0, 10), 0);
    double before = 0;
    for (double depth = -1; depth < 6; depth += 0.01) {
        const double part = lod::depth_part(depth, 10);
        EXPECT_GE(part, before);
        EXPECT_LT(part - before, 0.0031) << "no jump";
        before = part;
    }
}

TEST(Waves, ComeLongestFirst) {
    const Waves waves({{{1, 0}, 0.1, 3, 0}, {{0, 0.1}, 1, 1, 0}, {{-0.5, 0}, 0.2, 2, 0}});
    EXPECT_EQ(waves.components()[0].omega, 1);
    EXPECT_EQ(waves.components()[1].omega, 2);
    EXPECT_EQ(waves.components()[2].omega, 3);
    EXPECT_NEAR(waves.components()[0].length_m(), 20 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(waves.crest_m(), 1.3, 1e-15);
}

}  // namespace
}  // namespace relevo
