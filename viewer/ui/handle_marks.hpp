#pragma once

#include <optional>
#include <vector>

#include "lod/view.hpp"

namespace relevo::viewer {

/// What of the measured shapes can be taken hold of, besides all of their vertices.
struct Handles {
    std::vector<geo::Ecef> middles;  ///< of sides: dragged, they become vertices
    std::optional<geo::Ecef> hovered;
    std::optional<geo::Ecef> chosen;
};

/// Draws them over the shapes. \pre between Ui::begin and end
void draw_handles(const Handles& handles, const lod::View& view);

}  // namespace relevo::viewer
