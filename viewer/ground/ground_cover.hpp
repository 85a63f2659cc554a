#pragma once

#include "geo/frame.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ground/ground_map.hpp"

namespace relevo::viewer {

/// What the layer `terrain` is drawn with besides the ground's pages: the materials' tiles, and where they
/// lie.
class GroundCover {
  public:
    /// Makes the tiles, on all cores. \pre a context is current
    /// \param map  null: what is where follows from the data alone
    explicit GroundCover(const GroundMap* map);

    /// Lays the tiles for an eye.
    void update(const geo::GridFrame& grid, geo::LatLon eye);

    /// Binds all to the units that the shader says.
    void bind() const;

  private:
    GlTexture materials_;
    GlTexture map_;  // only where there is one
    GlBuffer block_;
};

}  // namespace relevo::viewer
