#include "lod/ocean/wind_sea.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace relevo {
namespace {

using lod::kGravity;
using lod::Wind;
using lod::WindSea;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Wind wind(double speed_m_s, double fetch_m = 500e3) {
    return {speed_m_s, geo::Degrees{}, fetch_m};
}

TEST(WindSea, FullyDevelopedIsPiersonAndMoskowitz) {
    for (const double u : {1.0, 5.0, 10.0, 20.0, 35.0}) {
        const WindSea sea(wind(u, kInfinity));
        const double u19 = 1.06 * u;
        EXPECT_NEAR(sea.significant_height_m() / (0.21 * u19 * u19 / kGravity), 1, 0.02) << u;
        EXPECT_NEAR(sea.peak_rad_s() * u19 / kGravity, 0.877, 1e-12) << u;
        // The integral of a omega^-5 exp(-1.25 (p / omega)^4), in closed form.
        const double closed = 4 * std::sqrt(0.0081 * kGravity * kGravity / 5 / std::pow(sea.peak_rad_s(), 4));
        EXPECT_NEAR(sea.significant_height_m() / closed, 1, 1e-5) << u;
    }
}

TEST(WindSea, FollowsTheFetchRelationsOfJonswap) {
    for (const double u : {5.0, 10.0, 25.0}) {
        for (const double x : {1e2, 3e2, 1e3, 1.8e3}) {
            const WindSea sea(wind(u, x * u * u / kGravity));
            // Frequency by Hasselmann's exponent, height by the measured energy, 1.6e-7 x, which the measured
            // shape of the spectrum meets but roughly.
            const double peak_hz = 3.5 * std::pow(x, -0.33) * kGravity / u;
            EXPECT_NEAR(sea.peak_rad_s() / (2 * std::numbers::pi * peak_hz), 1, 0.03);
            EXPECT_NEAR(sea.significant_height_m() / (1.6e-3 * std::sqrt(x) * u * u / kGravity), 1, 0.21)
                << u << ' ' << x;
        }
    }
}

TEST(WindSea, IsHighestAtItsPeak) {
    for (const double fetch : {10e3, 100e3, 1000e3}) {
        const WindSea sea(wind(12, fetch));
        const double p = sea.peak_rad_s();
        for (double ratio = 0.2; ratio < 8; ratio += 0.01) {
            EXPECT_LE(sea.density(ratio * p), sea.density(p) * (1 + 1e-12)) << ratio;
        }
        EXPECT_NEAR(sea.peak_length_m(), 2 * std::numbers::pi * kGravity / (p * p), 1e-9);
    }
}

TEST(WindSea, GrowsWithFetchAndWindAndNeverJumps) {
    for (const double u : {3.0, 10.0, 30.0}) {
        double before = 0;
        for (double fetch = 1e3; fetch < 1e7; fetch *= 1.02) {
            const double height = WindSea(wind(u, fetch)).significant_height_m();
            EXPECT_GE(height, before * (1 - 1e-6)) << u << ' ' << fetch;
            if (before > 0) {
                EXPECT_LT(height, before * 1.02) << u << ' ' << fetch;
            }
            before = height;
        }
    }
    double before = 0;
    for (double u = 0.5; u < 60; u *= 1.02) {
        const double height = WindSea(wind(u)).significant_height_m();
        EXPECT_GT(height, before) << u;
        before = height;
    }
}

TEST(WindSea, VarianceIsTheIntegral) {
    const WindSea sea(wind(15, 120e3));
    const double p = sea.peak_rad_s();
    for (const auto& [from, to] :
         {std::pair{0.0, 30 * p}, {0.8 * p, 0.9 * p}, {0.95 * p, 1.3 * p}, {5 * p, 9 * p}}) {
        // Simpson's rule in frequency, far finer.
        const int steps = 200000;
        const double step = (to - from) / steps;
        long double sum = sea.density(from) + sea.density(to);
        for (int k = 1; k < steps; ++k) sum += (k % 2 ? 4 : 2) * sea.density(from + k * step);
        const double integral = static_cast<double>(sum * step / 3);
        EXPECT_NEAR(sea.variance(from, to) / integral, 1, 1e-4) << from << ' ' << to;
    }
    EXPECT_NEAR(sea.variance(0, p) + sea.variance(p, kInfinity), sea.variance(0, kInfinity), 1e-5);
}

TEST(WindSea, SpreadsAsItsQuantilesSay) {
    const WindSea sea(wind(10));
    for (const double ratio : {0.3, 0.7, 1.0, 1.5, 4.0}) {
        const double omega = ratio * sea.peak_rad_s();
        // Donelan's beta as printed, and sech^2 summed.
        const double beta = ratio < 0.56   ? 2.61 * std::pow(0.56, 1.3)
                            : ratio < 0.95 ? 2.61 * std::pow(ratio, 1.3)
                            : ratio < 1.6  ? 2.28 * std::pow(ratio, -1.3)
                                           : 1.24;
        const auto sech2 = [&](double angle) { return 1 / std::pow(std::cosh(beta * angle), 2); };
        const int steps = 20000;
        const double step = 2 * std::numbers::pi / steps;
        double all = 0;
        for (int k = 0; k < steps; ++k) all += sech2(-std::numbers::pi + (k + 0.5) * step) * step;
        double below = 0;
        for (int k = 0; k < steps; ++k) {
            const double angle = -std::numbers::pi + k * step;
            if (below > 1e-6 && below < 1 - 1e-6) {
                EXPECT_NEAR(sea.spread_rad(omega, below), angle, 0.01) << ratio;  // 1.24 is rounded
            }
            below += sech2(angle + 0.5 * step) * step / all;
        }
        EXPECT_EQ(sea.spread_rad(omega, 0.5), 0);
        EXPECT_NEAR(sea.spread_rad(omega, 1), std::numbers::pi, 1e-3);
    }
}

TEST(WindSea, IsCalmWithoutWindOrFetch) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Wind& calm : {wind(0), wind(-3), wind(nan), wind(10, 0), wind(10, -1), wind(10, nan)}) {
        const WindSea sea(calm);
        EXPECT_EQ(sea.peak_rad_s(), 0);
        EXPECT_EQ(sea.peak_length_m(), 0);
        EXPECT_EQ(sea.density(1), 0);
        EXPECT_EQ(sea.significant_height_m(), 0);
    }
}

}  // namespace
}  // namespace relevo
