#pragma once

#include <optional>

#include "lod/terrain.hpp"

namespace relevo::lod {

/// Where a ray first meets the full-resolution surface.
struct Hit {
    geo::GridPosition place;
    double distance_m = 0;  ///< along the ray
};

/// First intersection of a ray with the triangles of the full data, whatever is drawn; voids and padding are
/// open. Descends the nested spheres: about the cost of a handful of frames' vertices. \param origin,
/// direction  ECEF; the direction is a unit vector
std::optional<Hit> pick(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction,
                        double exaggeration = 1);

}  // namespace relevo::lod
