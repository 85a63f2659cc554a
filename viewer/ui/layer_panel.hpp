#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "viewer/flight/ground_layers.hpp"
#include "viewer/overlay/overlay.hpp"
#include "viewer/ui/panels.hpp"

namespace relevo::viewer {

/// Of an overlay, for people: "contours", or its file's name.
std::string overlay_name(const Overlay& overlay, const Drapes& drapes);

/// All that can be drawn over the ground, the uppermost first: rows are dragged or moved by buttons, switched
/// on and off, and files taken away. \param chosen  the one that keys move \pre inside a window between
/// Ui::begin and end
void draw_layer_list(Overlays& overlays, GroundLayers& layers, std::size_t& chosen,
                     std::vector<Wish>& wishes);

}  // namespace relevo::viewer
