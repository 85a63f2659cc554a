#pragma once

#include <functional>
#include <span>

#include "ingest/affine.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// A smooth map of places, in place; NaN where it is not defined.
using ExactTransform = std::function<void(std::span<Place>)>;

/// Largest error of an interpolated position, in posts of the grid that it is in.
inline constexpr double kPositionTolerance = 1e-3;

/// The map at every post of a window, at most `tolerance` away from the exact one.
///
/// The window is cut into tiles of 64 posts a side, and a tile into cells with the exact map at their corners
/// and bilinear interpolation inside. For a map with second derivatives f_uu and f_vv the error in a cell of
/// size a x b is at most (a^2 |f_uu| + b^2 |f_vv|) / 8 (the mixed term is reproduced), which is what the
/// errors in the middles of two neighbouring edges add up to; these are measured, together with the one at
/// the centre. Twice their sum (room for derivatives that change inside a cell) must be within the tolerance,
/// or the tile takes cells of half the size, down to single posts, where nothing is interpolated. About 10
/// exact positions a tile suffice for a UTM zone.
///
/// Tiles lie at multiples of 64 from (0, 0), and a post's result depends on its tile alone: windows that
/// start at such multiples, and end at one or at the grid's edge, agree. \pre window.column and window.row
/// are multiples of kTransformTile
lod::Raster<Place> transform_posts(const ExactTransform& exact, Window window,
                                   double tolerance = kPositionTolerance);

inline constexpr int kTransformTile = 64;

}  // namespace relevo::ingest
