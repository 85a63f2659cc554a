#include "lod/ocean/wind_sea.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relevo::lod {

namespace {

constexpr double kPi = std::numbers::pi;

// JONSWAP, from the dimensionless fetch x = g F / U^2: 2 pi 3.5 (g / U) x^-0.33, 0.076 x^-0.22, 3.3.
constexpr double kPeak = 22;
constexpr double kAlpha = 0.076;
constexpr double kAlphaPower = -0.22;
constexpr double kGamma = 3.3;

// Pierson & Moskowitz: 0.877 g / U and 0.0081. Their wind blew at 19.5 m, 1.06 times that at 10 m by the
// logarithmic profile with a drag of 0.0013: 1 + sqrt(0.0013) / 0.4 ln(1.95).
constexpr double kDevelopedPeak = 0.877 / 1.06;
constexpr double kDevelopedAlpha = 0.0081;

}  // namespace

WindSea::WindSea(const Wind& wind) {
    if (!(wind.speed_m_s > 0 && wind.fetch_m > 0)) return;
    const double u = wind.speed_m_s;
    const double full_x = std::pow(kPeak / kDevelopedPeak, 3);
    const double x = std::min(kGravity * wind.fetch_m / (u * u), full_x);
    // The two laws do not meet where their peaks do: JONSWAP's sea would be a quarter higher. Over the last
    // decade of fetch one becomes the other, so that a longer fetch never lowers the sea.
    const double developed = std::clamp(1 + std::log10(x / full_x), 0.0, 1.0);
    peak_ = kPeak * (kGravity / u) / std::cbrt(x);
    alpha_ = std::lerp(kAlpha * std::pow(x, kAlphaPower), kDevelopedAlpha, developed);
    gamma_ = std::lerp(kGamma, 1.0, developed);
}

double WindSea::peak_length_m() const {
    return peak_ > 0 ? 2 * kPi * kGravity / (peak_ * peak_) : 0;
}

double WindSea::density(double rad_s) const {
    if (!(peak_ > 0 && rad_s > 0)) return 0;
    const double ratio = rad_s / peak_;
    const double width = ratio <= 1 ? 0.07 : 0.09;
    const double off = (ratio - 1) / width;
    return alpha_ * kGravity * kGravity * std::pow(rad_s, -5) * std::exp(-1.25 * std::pow(ratio, -4)) *
           std::pow(gamma_, std::exp(-0.5 * off * off));
}

double WindSea::variance(double from_rad_s, double to_rad_s) const {
    // Below and above these is less than 2e-6 of the whole.
    const double from = std::max(from_rad_s, 0.3 * peak_);
    const double to = std::min(to_rad_s, 30 * peak_);
    if (!(from < to)) return 0;
    const double width = std::log(to / from);
    const int steps = static_cast<int>(std::ceil(width / 0.005));
    const double step = width / steps;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double at = from * std::exp((k + 0.5) * step);
        sum += density(at) * at;
    }
    return sum * step;
}

double WindSea::significant_height_m() const {
    return 4 * std::sqrt(variance(0, 30 * peak_));
}

double WindSea::spread_rad(double rad_s, double quantile) const {
    const double ratio = std::clamp(rad_s / peak_, 0.56, 1.6);
    const double beta = ratio < 0.95 ? 2.61 * std::pow(ratio, 1.3) : 2.28 * std::pow(ratio, -1.3);
    return std::atanh((2 * quantile - 1) * std::tanh(beta * kPi)) / beta;
}

double deep_water_rad_s(double length_m) {
    return std::sqrt(2 * kPi * kGravity / length_m);
}

}  // namespace relevo::lod
