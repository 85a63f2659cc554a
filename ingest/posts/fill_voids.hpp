#pragma once

#include <cstdint>

#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// Widest voids that can be filled, posts.
inline constexpr int kWidestFill = 255;

/// How far around a block its filled posts depend on others, in posts.
inline constexpr int fill_halo(int width) {
    return 2 * width + 1;
}

/// Interpolates voids up to `width` posts wide in the part `inside` of a raster: GDALFillNodata, the nearest
/// valid post in each of four quadrants, at most 2 * width posts away, weighted by inverse distance.
///
/// A void is wide where a square of width + 1 by width + 1 void posts fits into it; so a long crack of one
/// post is narrow. Everything beyond the data's border counts as void: a void that is open to the border is
/// wide there. A post is filled where nothing wide can be reached from it in `width` steps from void to
/// void, sideways or diagonally; so the ragged edge of a wide void stays void with it.
///
/// Filled posts become land and are marked as filled; nothing else changes.
///
/// \param heights, marks  of the block and fill_halo(width) posts around it, as far as the data goes (a side
///                        of `inside` with less beside it is the data's border): as they were before any
///                        block was filled
/// \param width           1 .. kWidestFill
/// \param whole_metres    round filled heights, for scenes that store whole metres
/// \return the number of posts filled; a post does not depend on how the data is cut into blocks
Result<std::uint64_t> fill_voids(lod::Raster<float>& heights, lod::Raster<lod::PostMark>& marks,
                                 Window inside, int width, bool whole_metres = false);

}  // namespace relevo::ingest
