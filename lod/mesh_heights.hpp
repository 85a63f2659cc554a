#pragma once

#include "geo/frame.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::lod {

/// Heights for every post of the padded grid, for meshes alone: the data where there is some; voids filled
/// smoothly from around them, so that triangles which reach into a void follow the ground that they leave;
/// padding continued from the data's edge. Nothing measures these. \param heights  of the data, metres, void
/// = NaN
Raster<float> mesh_heights(const geo::GridFrame& frame, const Raster<float>& heights);

}  // namespace relevo::lod
