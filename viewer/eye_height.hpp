#pragma once

#include <optional>

#include "geo/geoid.hpp"
#include "geo/position.hpp"
#include "geo/result.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/terrain.hpp"

namespace relevo::viewer {

/// Turns heights above a scene's vertical datum into heights above the ellipsoid and back, anywhere on earth,
/// also outside the scene. A datum whose geoid is not here is drawn above EGM96, as its scene is.
class EyeHeight {
  public:
    static Result<EyeHeight> create(lod::VerticalDatum datum);

    geo::Undulation undulation(geo::LatLon place) const;

  private:
    std::optional<geo::Geoid> geoid_;
};

/// Height h of the drawn ground at a place: bilinear between the posts of the full data, whatever the mesh.
/// Nothing outside the data and in voids.
std::optional<geo::EllipsoidalHeight> ground_height(const lod::Terrain& terrain, geo::LatLon place,
                                                    double exaggeration);

}  // namespace relevo::viewer
