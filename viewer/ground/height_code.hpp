#pragma once

#include <cstdint>

#include "viewer/ground/ground_data.hpp"

namespace relevo::viewer {

/// How a height lies in 16 bits of a texel: H = middle_m + step_m * code, the code from -32767 to 32767.
///
/// The step is a power of two, and the middle a multiple of it: heights in whole metres, which most elevation
/// data has, are exact wherever the data's range is less than 65 534 m, and so are halves, quarters and
/// eighths up to a range of 8191 m. A plain of a contour's very height is then at that height and not beside
/// it, which is what decides on which side of the plain the contour runs. Other heights are off by at most
/// step_m / 2: 6 cm up to a range of 8191 m, 3 cm up to 4095 m.
struct HeightCode {
    double middle_m = 0;
    double step_m = 1;

    std::int16_t of(double H) const;

    /// What texels of 1 are above the middle, metres: OpenGL takes codes as parts of 32767.
    double half_m() const { return 32767 * step_m; }
};

/// The finest that the data's range allows.
HeightCode height_code(const GroundFacts& facts);

}  // namespace relevo::viewer
