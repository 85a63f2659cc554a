#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "viewer/overlay/overlay_figures.hpp"

namespace relevo::app {

/// `overlays` of `render --json` and `view --json`.
nlohmann::json overlays_json(const std::vector<viewer::OverlayFigures>& overlays);

}  // namespace relevo::app
