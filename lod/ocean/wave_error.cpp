#include "lod/ocean/wave_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
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

double spacing_for(const Waves& waves, double error_m) {
    constexpr double kFlat = std::numeric_limits<double>::infinity();
    if (mesh_error_m(waves, kFlat) <= error_m) return kFlat;
    double fine = 0;
    double coarse = waves.components().front().length_m() / kFadeFrom;  // draws nothing any more
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (fine + coarse);
        (mesh_error_m(waves, middle) <= error_m ? fine : coarse) = middle;
    }
    return fine;
}

double spacing_slope(const Waves& waves, double focal_px, double error_px, double nearest_m) {
    assert(focal_px > 0 && error_px > 0 && nearest_m > 0);
    constexpr double kStep = 1.01;
    const double metres_a_metre = error_px / focal_px;
    const double flat_from = mesh_error_m(waves, std::numeric_limits<double>::infinity()) / metres_a_metre;
    double slope = 0.5;
    // All of a step keeps what its near end allows if its far end, where the mesh is coarser, does.
    double near = nearest_m;
    while (near < flat_from) {
        const double allowed = metres_a_metre * near;
        const double far = near * kStep;
        if (mesh_error_m(waves, slope * far) > allowed) slope = spacing_for(waves, allowed) / far;
        near = far;
    }
    return slope;
}

}  // namespace relevo::lod
