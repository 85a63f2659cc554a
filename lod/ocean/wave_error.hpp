#pragma once

#include "lod/ocean/waves.hpp"

namespace relevo::lod {

// How finely a mesh must sample waves. Its vertices lie on a lattice of a local spacing, in squares that are
// cut along a diagonal, and carry each wave faded by `sampled_part`: too few vertices to a wave would draw
// another, longer one (aliases), which a shimmering sea is made of. The shader fades by the same numbers.

inline constexpr double kFadeFrom = 2.85;  ///< vertices a wavelength that draw nothing of a wave yet
inline constexpr double kFadeTo = 4.5;     ///< that draw all of it

/// Part of a wave's amplitude that a mesh carries, by its length over the mesh's spacing: 0 to 1, smooth.
double sampled_part(double length_over_spacing);

/// Most that triangles are off a wave of amplitude 1 that their vertices lie on: over a crest across the
/// longest edge, the diagonal, 1 - cos(pi sqrt 2 / n); 2 where a diagonal spans a wavelength.
double interpolation_error(double length_over_spacing);

/// Bound for what a mesh of this spacing is off the waves' height, faded waves and all: of the waves' single
/// bounds their sum, which holds everywhere, or where it is less 4.5 standard deviations, which 7 places in a
/// million exceed. Never falls as the spacing grows.
double mesh_error_m(const Waves& waves, double spacing_m);

}  // namespace relevo::lod
