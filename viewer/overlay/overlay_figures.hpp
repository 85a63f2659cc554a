#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viewer/draw_settings.hpp"
#include "viewer/overlay/overlay.hpp"
#include "viewer/renderer.hpp"

namespace relevo::viewer {

/// What an overlay took besides its part of the ground's program.
struct OverlayFigures {
    Overlay overlay;
    std::uint64_t tiles = 0;  ///< loaded
    int gl_objects = 0;
    std::size_t bytes = 0;  ///< of them
};

/// Of all that the settings draw, from the lowest up. Those that are off are not there.
std::vector<OverlayFigures> overlay_figures(const Renderer& renderer, const DrawSettings& settings);

}  // namespace relevo::viewer
