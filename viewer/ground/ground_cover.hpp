#pragma once

#include "geo/frame.hpp"
#include "viewer/gl_object.hpp"

namespace relevo::viewer {

/// What the layer `terrain` is drawn with besides the ground's pages: the materials' tiles, and where they
/// lie.
class GroundCover {
  public:
    /// Makes the tiles, on all cores. \pre a context is current
    GroundCover();

    /// Lays the tiles for an eye.
    void update(const geo::GridFrame& grid, geo::LatLon eye);

    /// Binds all to the units that the shader says.
    void bind() const;

  private:
    GlTexture materials_;
    GlBuffer block_;
};

}  // namespace relevo::viewer
