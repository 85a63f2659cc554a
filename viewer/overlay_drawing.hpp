#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/draw_settings.hpp"
#include "viewer/gl_object.hpp"
#include "viewer/graticule.hpp"
#include "viewer/ground/height_code.hpp"
#include "viewer/ground_scale.hpp"

namespace relevo::viewer {

/// What a terrain program needs to draw these over its layer: definitions of shaders/overlays.glsl.
std::string overlay_defines(const std::vector<Overlay::Kind>& overlays);

/// What shaders/overlays.glsl reads. It is made for the first picture that has overlays.
class OverlayDrawing {
  public:
    /// \pre a context is current. The terrain must outlive this.
    OverlayDrawing(const lod::Terrain& terrain, const GroundFacts& facts);

    /// Sets what a picture needs.
    void update(const lod::View& view, const DrawSettings& settings);

    /// Binds all to where the shader says.
    void bind() const;

    /// Of the last picture.
    std::optional<double> contour_interval_m() const { return contour_interval_m_; }
    const std::optional<Graticule>& graticule() const { return graticule_; }

  private:
    const lod::Terrain* terrain_;
    GroundScale scale_;
    HeightCode code_;
    GlBuffer block_;
    std::optional<double> contour_interval_m_;
    std::optional<Graticule> graticule_;
};

}  // namespace relevo::viewer
