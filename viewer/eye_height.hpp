#pragma once

#include <optional>

#include "geo/geoid.hpp"
#include "geo/position.hpp"
#include "geo/result.hpp"
#include "lod/terrain.hpp"

namespace relevo::viewer {

/// Turns heights above a scene's vertical datum into heights above the ellipsoid and back, anywhere on earth:
/// by the scene's geoid, and where that does not reach by EGM96, which is only loaded then; without that by a
/// continuation of the scene's.
class EyeHeight {
  public:
    /// \param geoid  the scene's, which outlives this; null where its heights are above the ellipsoid
    explicit EyeHeight(const geo::Geoid* geoid) : geoid_(geoid) {}

    /// Not to be called from two threads at once.
    geo::Undulation undulation(geo::LatLon place) const;

  private:
    const geo::Geoid* geoid_;
    mutable std::optional<Result<geo::Geoid>> elsewhere_;
};

/// Height h of the drawn ground at a place: bilinear between the posts of the full data, whatever the mesh.
/// Nothing outside the data and in voids.
std::optional<geo::EllipsoidalHeight> ground_height(const lod::Terrain& terrain, geo::LatLon place,
                                                    double exaggeration);

}  // namespace relevo::viewer
