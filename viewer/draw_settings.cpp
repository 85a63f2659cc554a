#include "viewer/draw_settings.hpp"

namespace relevo::viewer {

DrawSettings draw_settings(const ViewState& view) {
    DrawSettings settings{.layer = view.layer,
                          .shading = view.shading,
                          .wireframe = view.wireframe,
                          .exaggeration = view.exaggeration,
                          .sun = view.sun,
                          .haze = view.haze,
                          .ocean = view.ocean,
                          .overlays = view.layer == Layer::plain ? Overlays{} : view.overlays,
                          .ramp = view.ramp};
    if (view.layer == Layer::plain || (view.ocean.kind == OceanKind::automatic &&
                                       view.layer != Layer::hypsometric && view.layer != Layer::terrain))
        settings.ocean.kind = OceanKind::off;
    settings.ocean.error_px = view.tau_px;
    return settings;
}

}  // namespace relevo::viewer
