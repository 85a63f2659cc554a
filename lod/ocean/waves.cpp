#include "lod/ocean/waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kLongest = 2.5;        // times the peak's length: longer waves have 0.04 % of the energy
constexpr double kShortest = 1;         // m, middle of the last band
constexpr double kNarrowestBand = 1.1;  // its lengths' ratio: below, waves would only beat with each other

/// In [0, 1), the same on every machine: the standard's distributions differ between libraries.
double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

double airy_rad_s(double k, double depth_m) {
    return std::sqrt(kGravity * k * std::tanh(k * depth_m));
}

}  // namespace

double WaveComponent::length_m() const {
    return kTwoPi / glm::length(k);
}

Waves::Waves(std::vector<WaveComponent> components) : components_(std::move(components)) {
    std::stable_sort(components_.begin(), components_.end(),
                     [](const auto& a, const auto& b) { return a.length_m() > b.length_m(); });
}

Waves Waves::of_wind(const Wind& wind, std::uint64_t seed, double depth_m) {
    const WindSea sea(wind);
    const double longest = kLongest * sea.peak_length_m();
    if (!(longest > kShortest)) return {};

    const double octaves = std::log(longest / kShortest);
    const int bands = std::min(kComponents, 1 + static_cast<int>(octaves / std::log(kNarrowestBand)));
    const double band = octaves / (bands - 0.5);  // ends half a band below the shortest
    const auto length_at = [&](double bands_down) { return longest * std::exp(-band * bands_down); };
    const double towards = wind.from.radians() + std::numbers::pi;

    std::mt19937_64 random(seed);
    std::vector<WaveComponent> components;
    for (int i = 0; i < bands; ++i) {
        const double length = length_at(i + uniform(random));
        const double spread_quantile = uniform(random);
        const double phase = kTwoPi * uniform(random);

        const double azimuth = towards + sea.spread_rad(deep_water_rad_s(length), spread_quantile);
        const double k = kTwoPi / length;
        const double energy =
            sea.variance(deep_water_rad_s(length_at(i)), deep_water_rad_s(length_at(i + 1)));
        components.push_back({k * glm::dvec2(std::sin(azimuth), std::cos(azimuth)), std::sqrt(2 * energy),
                              airy_rad_s(k, depth_m), phase});
    }
    return Waves(std::move(components));
}

double Waves::height(const glm::dvec2& at, double time_s) const {
    double sum = 0;
    for (const auto& c : components_) {
        sum += c.amplitude_m * std::cos(glm::dot(c.k, at) - c.omega * time_s + c.phase);
    }
    return sum;
}

double Waves::height(const glm::dvec2& at, double time_s, double depth_m) const {
    double sum = 0;
    for (const auto& c : components_) {
        sum += depth_part(depth_m, c.length_m()) * c.amplitude_m *
               std::cos(glm::dot(c.k, at) - c.omega * time_s + c.phase);
    }
    return sum;
}

double Waves::crest_m() const {
    double sum = 0;
    for (const auto& c : components_) sum += c.amplitude_m;
    return sum;
}

double Waves::significant_height_m() const {
    double variance = 0;
    for (const auto& c : components_) variance += 0.5 * c.amplitude_m * c.amplitude_m;
    return 4 * std::sqrt(variance);
}

double Waves::slope_variance() const {
    double sum = 0;
    for (const auto& c : components_) sum += 0.5 * c.amplitude_m * c.amplitude_m * glm::dot(c.k, c.k);
    return sum;
}

double depth_part(double depth_m, double length_m) {
    return glm::smoothstep(0.0, 1.0, 2 * depth_m / length_m);
}

double cox_munk_slope_variance(double wind_m_s) {
    return 0.003 + 0.00512 * wind_m_s;
}

}  // namespace relevo::lod
