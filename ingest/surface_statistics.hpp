#pragma once

#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// Fills in the range of heights, the numbers of valid and void posts, and the largest difference between the
/// bilinear surface and the two triangles of a cell: |z00 + z11 - z01 - z10| / 4, in the cell's middle, over
/// cells without voids.
void add_statistics(const lod::Raster<float>& heights, lod::SceneInfo& info);

/// Can all heights be stored as int16? \pre they are whole numbers
bool fits_int16(const lod::Raster<float>& heights);

}  // namespace relevo::ingest
