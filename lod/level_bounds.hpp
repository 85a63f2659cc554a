#pragma once

#include <vector>

#include "geo/frame.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// Upper bounds, by vertex level, for the bare surface H = 0 (the geoid on the curved earth): what an
/// exaggeration e adds to stored errors and radii (docs/design.md): delta_e = e delta + |e - 1| sag, r_e = e
/// r + |e - 1| radius. They are nested: a level's bounds are at least the next finer level's.
struct LevelBound {
    double sag_m = 0;     ///< distance between the surface and any triangle of a diamond of this level
    double radius_m = 0;  ///< of the nested spheres
};

/// From the second derivatives of the ellipsoid (closed form) and of the geoid (differences of its nodes).
std::vector<LevelBound> level_bounds(const geo::GridFrame& frame, const UndulationGrid& undulations);

}  // namespace relevo::lod
