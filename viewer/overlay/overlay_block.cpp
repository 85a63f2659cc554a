#include "viewer/overlay/overlay_block.hpp"

#include <cmath>

namespace relevo::viewer {

std::array<float, 2> contour_scale(const HeightCode& code, double interval_m) {
    const double lines = (code.middle_m + 0.25 * code.step_m) / interval_m;
    return {static_cast<float>(code.half_m() / interval_m),
            static_cast<float>(lines - 5 * std::round(lines / 5))};
}

}  // namespace relevo::viewer
