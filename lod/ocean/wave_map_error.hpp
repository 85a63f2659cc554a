#pragma once

#include <vector>

#include "lod/ocean/wave_map.hpp"

namespace relevo::lod {

/// What meshes are off a map's waves: for waves of a map what mesh_error_m (wave_error.hpp) is for a wind's.
///
/// Measured, not derived: at 32 768 places of a tile the most that a diagonal of a cell, the farthest from
/// what it replaces of all that a mesh has, differs at its middle from the map, in any direction; and a tenth
/// more. Both copies' largest errors are added, as if they met. Takes 0.2 s, of 1024 posts a side 0.5 s.
class WaveMapError {
  public:
    explicit WaveMapError(const WaveMap& map);

    /// Most that a mesh of this spacing is off the map's height, faded waves and all. Never falls as the
    /// spacing grows.
    double at(double spacing_m) const;

    /// A mesh of this spacing draws nothing of the map.
    double longest_m() const;

  private:
    double of_tile(double spacing) const;

    std::vector<double> tile_m_;  ///< of the copies
    double finest_;               ///< spacing of the first error, in parts of a tile
    std::vector<double> errors_;  ///< of one copy, at spacings that grow by sqrt 2 each
};

}  // namespace relevo::lod
