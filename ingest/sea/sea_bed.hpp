#pragma once

#include "geo/frame.hpp"
#include "ingest/affine.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// How far from a block the sea bed in it depends on posts, in posts.
inline constexpr int kSeaBedHalo = 64;

/// Gives heights to the posts of a block that are sea without a height (marked as modelled): a bed that falls
/// by 1 m in 100 m from the nearest post that has a height in the data, in whole metres, down to -200 m or
/// to what that slope reaches in kSeaBedHalo posts. It continues the data's own level where that is the sea
/// surface, and is for pictures: nobody measured it.
/// \param heights, marks  of the block and kSeaBedHalo posts around it, as far as the data goes; whether the
///                        halo's own sea is marked already makes no difference
/// \param inside          the block in them
/// \param first_column, first_row  of the rasters, in posts of the frame
void model_sea_bed(const geo::GridFrame& frame, int first_column, int first_row, Window inside,
                   lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks);

}  // namespace relevo::ingest
