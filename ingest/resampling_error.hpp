#pragma once

#include "geo/result.hpp"
#include "ingest/grid_map.hpp"
#include "ingest/progress.hpp"
#include "ingest/source.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// The scene's surface (bilinear between its posts, as measuring tools read it) against every valid post of
/// the source. \param part_wanted  the scene is a crop: source posts outside of it are not lost
Result<lod::ResamplingError> resampling_error(const Source& source, const GridMap& map,
                                              const geo::GridFrame& frame, const lod::Raster<float>& heights,
                                              bool part_wanted, const Stage& stage);

}  // namespace relevo::ingest
