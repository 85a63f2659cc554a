#pragma once

#include "geo/result.hpp"
#include "ingest/grid_map.hpp"
#include "ingest/progress.hpp"
#include "ingest/resample.hpp"
#include "ingest/source.hpp"
#include "ingest/target_frame.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// The source's own posts, north-west first; and by how much float32 rounds them (the error of a source's
/// posts in the scene where nothing is resampled).
struct OwnHeights {
    lod::Raster<float> heights;
    lod::ResamplingError rounding;
};
Result<OwnHeights> read_own_heights(const Source& source, const OwnWindow& own, const Stage& stage);

/// Heights at the frame's posts, void = NaN. Work goes in blocks of the scene's block side, rows of a block
/// in parallel; a post's height depends neither on threads nor on how much of the source is read at once.
Result<lod::Raster<float>> warp_heights(const Source& source, const GridMap& map, const geo::GridFrame& frame,
                                        Resampling method, const Stage& stage);

}  // namespace relevo::ingest
