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
    terrain,      ///< grass, rock, gravel and snow, by day and by night
    plain,        ///< one colour, lit at the vertices: nothing a pixel but blending, for measuring
    aspect,       ///< the direction in which the true ground falls; flat ground is grey
};

std::string_view to_string(Layer layer);
Result<Layer> parse_layer(std::string_view text);

/// The heights of a scene, metres.
struct HeightSpan {
    double low = 0;
    double high = 1;
    double land_low = 0;  ///< the lowest that is not sea
};

/// A layer's colours from its lowest value to its highest, RGBA. Lightness changes steadily along each, so
/// that equal steps of height or slope look equal and a grey copy still reads. Tints are those of land, from
/// green at its lowest; land below sea level is as green as any. \param span  only tints need it
std::vector<std::array<std::uint8_t, 4>> colour_ramp(Layer layer, const HeightSpan& span = {});

/// Tints of the sea over the same heights: blue, deeper is darker.
std::vector<std::array<std::uint8_t, 4>> sea_ramp(const HeightSpan& span);

}  // namespace relevo::viewer
