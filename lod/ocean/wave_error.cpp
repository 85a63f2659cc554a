#include "lod/ocean/wave_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

namespace relevo::lod {

double sampled_part(double length_over_spacing) {
    return glm::smoothstep(kFadeFrom, kFadeTo, length_over_spacing);
}

double interpolation_error(double length_over_spacing) {
    if (!(length_over_spacing > std::numbers::sqrt2)) return 2;
    // 1 - cos(x), to the last digit for small x too.
    const double half = std::sin(std::numbers::pi / (std::numbers::sqrt2 * length_over_spacing));
    return 2 * half * half;
}

// A wave's bound is 1 - part (1 - interpolation error). Both factors fall as the spacing grows, and neither
// is negative: the second is not where anything is drawn, from kFadeFrom > 2 sqrt 2 on. So the bounds, their
// sums and the lesser of these never fall, and a bisection finds the largest spacing.
double mesh_error_m(const Waves& waves, double spacing_m) {
    static_assert(kFadeFrom > 2 * std::numbers::sqrt2);
    double sum = 0;
    double variance = 0;
    for (const auto& c : waves.components()) {
        const double samples = c.length_m() / spacing_m;
        const double part = sampled_part(samples);
        const double error = c.amplitude_m * (1 - part + part * interpolation_error(samples));
        sum += error;
        variance += 0.5 * error * error;
    }
    return std::min(sum, 4.5 * std::sqrt(variance));
}

}  // namespace relevo::lod
