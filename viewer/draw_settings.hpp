#pragma once

#include <array>
#include <memory>
#include <optional>

#include "viewer/haze.hpp"
#include "viewer/height_ramp.hpp"
#include "viewer/layer.hpp"
#include "viewer/ocean/ocean_settings.hpp"
#include "viewer/overlay/overlay.hpp"
#include "viewer/shading.hpp"
#include "viewer/sun_setting.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// How a scene is drawn.
struct DrawSettings {
    Layer layer = Layer::hypsometric;
    Shading shading = Shading::sun;  ///< of tints, hillshade and levels
    bool wireframe = false;
    double exaggeration = 1;
    SunSetting sun = {};
    Haze haze = {};
    /// A flat colour, 0 to 1, instead of sky, horizon and haze.
    std::optional<std::array<float, 3>> background = {};
    OceanSettings ocean = {.kind = OceanKind::off};
    /// Over all layers but the plain one, which pixels cost nothing.
    Overlays overlays = {};
    /// Of the tints, land and sea; null: the scene's own.
    std::shared_ptr<const HeightRamp> ramp = nullptr;
};

/// What a view says of it. Where it leaves the ocean open there is one in the tints and in the natural
/// ground: other layers show values of the ground, which water would cover. The plain layer, which pixels
/// cost nothing, never has one.
DrawSettings draw_settings(const ViewState& view);

}  // namespace relevo::viewer
