#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "geo/position.hpp"
#include "geo/result.hpp"
#include "lod/terrain.hpp"
#include "viewer/haze.hpp"
#include "viewer/height_ramp.hpp"
#include "viewer/layer.hpp"
#include "viewer/ocean/ocean_settings.hpp"
#include "viewer/overlay/overlay.hpp"
#include "viewer/shading.hpp"
#include "viewer/sun_setting.hpp"

namespace relevo::viewer {

/// How the mesh is made.
enum class Method {
    soar,  ///< view-dependent refinement
    lstr,  ///< nodes of a quadtree
    full,  ///< every triangle of the data
};
std::string_view to_string(Method method);
Result<Method> parse_method(std::string_view text);

std::string_view metric_name(lod::ErrorMetric metric);
Result<lod::ErrorMetric> parse_metric(std::string_view text);

/// "on" or "off".
Result<bool> parse_switch(std::string_view text);

/// Where one looks from, at what, and how it is drawn: everything that makes a picture, but for its size.
struct ViewState {
    geo::LatLon place{geo::Degrees{0}, geo::Degrees{0}};
    geo::OrthometricHeight H{1000};  ///< of the eye, above the scene's vertical datum
    geo::Degrees heading{0};
    geo::Degrees pitch{0};
    geo::Degrees roll{0};
    geo::Degrees fov{60};

    double tau_px = 1;
    Method method = Method::soar;
    lod::ErrorMetric metric = lod::ErrorMetric::bounded;
    bool morph = false;
    double exaggeration = 1;
    Layer layer = Layer::hypsometric;
    Shading shading = Shading::sun;
    bool wireframe = false;
    SunSetting sun;
    Haze haze;
    OceanSettings ocean;  ///< its error is tau_px
    Overlays overlays;
    std::shared_ptr<const HeightRamp> ramp;  ///< null: the tints' own
};

/// Fails with ErrorKind::usage where a value is out of its range.
Result<void> check(const ViewState& view);

/// The whole view as one string without spaces or characters that a shell knows:
/// "37.58,-105.49,4500/heading=90/pitch=-10/roll=0/fov=60/tau=1/lod=soar/metric=bounded/...". Parsing it
/// gives the same view, to the last bit. A map of waves and a ramp are not in it, nor are the files of
/// imagery and vectors: overlays tell the number of theirs.
std::string to_string(const ViewState& view);

/// Reads such a string. What it leaves out keeps the value it has in `base`; only the place must be there.
Result<ViewState> parse_view_state(std::string_view text, const ViewState& base = {});

}  // namespace relevo::viewer
