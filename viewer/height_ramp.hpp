#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geo/result.hpp"
#include "viewer/layer.hpp"

namespace relevo::viewer {

/// Colours of heights that a user chose in place of the tints.
struct HeightRamp {
    struct Stop {
        double at = 0;  ///< metres, or a part of the heights' range
        std::array<double, 3> colour{};
        bool is_part = false;  ///< of the range, 0 to 1, and not metres
    };
    std::vector<Stop> stops;  ///< at least one
};

/// Reads what gdaldem color-relief reads: a line a stop, "HEIGHT RED GREEN BLUE", heights in metres or
/// percent ("50%") of the scene's range, colours 0 to 255, separated by blanks, commas, tabs or colons; a
/// fourth colour, alpha, is left out, as is the line "nv" of no value, for voids are not drawn. Empty lines
/// and those that begin with # are left out. The error names the line.
Result<HeightRamp> parse_height_ramp(std::string_view text);

/// One of the names "viridis", "grey", "classic", or a file's.
Result<HeightRamp> read_height_ramp(const std::string& name_or_file);

/// Its colours over a scene's heights, as colour_ramp: linear between stops, the outermost ones go on.
std::vector<std::array<std::uint8_t, 4>> colours_of(const HeightRamp& ramp, const HeightSpan& span);

}  // namespace relevo::viewer
