#pragma once

#include <optional>

#include "lod/terrain.hpp"

namespace relevo::lod {

/// Where a ray first meets the surface.
struct Hit {
    geo::GridPosition place;
    double distance_m = 0;  ///< along the ray
    bool is_exact = true;   ///< of the full-resolution surface; else as much of it as is in memory
};

/// First intersection of a ray with the triangles of the full data, whatever is drawn; voids and padding are
/// open. Descends the nested spheres of the tiles in memory: about the cost of a handful of frames' vertices.
/// Tiles that it needs and does not find are told to the tile store, and the ground is as coarse as their
/// parents. \param origin, direction  ECEF; the direction is a unit vector
std::optional<Hit> pick(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction,
                        double exaggeration = 1);

/// The same, waiting for what is missing; exact unless tiles cannot be read or do not fit in memory.
std::optional<Hit> pick_exactly(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction,
                                double exaggeration = 1);

}  // namespace relevo::lod
