#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/ground/ground_data.hpp"
#include "viewer/height_ramp.hpp"
#include "viewer/layer.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What a layer's colours mean.
struct Legend {
    struct Mark {
        double at;  ///< along the colours, 0 to 1
        std::string text;
    };
    std::string title = {};                                 ///< "height", "slope", "aspect"
    std::string unit = {};                                  ///< "m", "°"
    std::vector<std::array<std::uint8_t, 4>> colours = {};  ///< from the lowest value to the highest
    std::vector<Mark> marks = {};                           ///< round values, rising; at most 9
    bool cyclic = false;                                    ///< the last colour is the first
};

/// Of a layer that shows values; nothing for the others. Marks of heights are at multiples of 1, 2 or 5 times
/// a power of ten.
/// \param span      the scene's heights
/// \param has_sea   heights below 0 are shown in the sea's colours
/// \param ramp      of the tints, where the user chose one
std::optional<Legend> legend(Layer layer, const HeightSpan& span, bool has_sea,
                             const HeightRamp* ramp = nullptr);

/// Of what a view shows. The sea has colours by depth where no water is drawn over it.
std::optional<Legend> legend(const ViewState& view, const GroundFacts& facts);

}  // namespace relevo::viewer
