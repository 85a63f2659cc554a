#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "geo/result.hpp"

namespace relevo::viewer {

/// What colours the ground.
enum class Layer {
    hypsometric,  ///< tints by height over the scene's range, with hillshade
    hillshade,    ///< light and shadow alone
    slope,        ///< steepness of the true ground, 0 to 60 degrees
    lod,          ///< the level of each triangle
};

std::string_view to_string(Layer layer);
Result<Layer> parse_layer(std::string_view text);

/// A layer's colours from its lowest value to its highest, RGBA. Lightness changes steadily along each, so
/// that equal steps of height or slope look equal and a grey copy still reads. Tints of heights up to 0,
/// which is what most files say of the sea, are blue, deeper is darker; above they begin anew with green.
/// \param low, high  the scene's heights, metres; only tints need them
std::vector<std::array<std::uint8_t, 4>> colour_ramp(Layer layer, double low = 0, double high = 1);

}  // namespace relevo::viewer
