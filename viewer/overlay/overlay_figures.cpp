#include "viewer/overlay/overlay_figures.hpp"

#include "viewer/overlay/overlay_list.hpp"

namespace relevo::viewer {

std::vector<OverlayFigures> overlay_figures(const Renderer& renderer, const DrawSettings& settings) {
    std::vector<OverlayFigures> figures;
    for (const Overlay& overlay : settings.overlays) {
        const auto drape =
            is_of_file(overlay) ? renderer.drape_figures(overlay.file) : OverlayDrawing::DrapeFigures{};
        figures.push_back({overlay, drape.tiles, drape.gl_objects, drape.bytes});
    }
    return figures;
}

}  // namespace relevo::viewer
