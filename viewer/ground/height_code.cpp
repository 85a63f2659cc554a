#include "viewer/ground/height_code.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

std::int16_t HeightCode::of(double H) const {
    return static_cast<std::int16_t>(std::lround(std::clamp((H - middle_m) / step_m, -32767.0, 32767.0)));
}

HeightCode height_code(const GroundFacts& facts) {
    const double half = std::max(0.5 * (facts.highest_m - facts.lowest_m), 1e-3);
    // Half a step of room, for the middle is rounded to a step.
    const double step = std::exp2(std::ceil(std::log2(half / 32766.5)));
    return {std::round(0.5 * (facts.highest_m + facts.lowest_m) / step) * step, step};
}

}  // namespace relevo::viewer
