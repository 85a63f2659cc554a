#include "app/overlay_json.hpp"

namespace relevo::app {

nlohmann::json overlays_json(const std::vector<viewer::OverlayFigures>& overlays) {
    nlohmann::json list = nlohmann::json::array();
    for (const viewer::OverlayFigures& overlay : overlays)
        list.push_back({{"overlay", to_string(viewer::Overlays{overlay.overlay})},
                        {"tiles", overlay.tiles},
                        {"gl_objects", overlay.gl_objects},
                        {"bytes", overlay.bytes}});
    return list;
}

}  // namespace relevo::app
