#pragma once

#include "geo/result.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::lod {

/// Heights of a box of posts, void = NaN; reads the blocks that it touches and no others.
Result<Raster<float>> read_box(const Scene& scene, const BlockGrid::Box& box);

}  // namespace relevo::lod
