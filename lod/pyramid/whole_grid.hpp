#pragma once

#include "geo/result.hpp"
#include "lod/error_metric.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/scene/level_block.hpp"

namespace relevo::lod {

/// Codes of all vertices of the padded grid, gathered from a pyramid's levels. \pre any block of the padded
/// grid may be read (ScenePyramid)
Result<VertexCodes> gather_codes(const Pyramid& pyramid, ErrorMetric metric);

}  // namespace relevo::lod
