#pragma once

#include "geo/result.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::lod {

/// What a scene stores of a tile's codes (MetricBuilder::add_tile): every 2nd post. The other three quarters,
/// the vertices of the last two levels, follow from the heights around them.
MetricRasters stored_part(const MetricRasters& tile);

/// The metrics of a scene's whole padded grid, the last two levels computed again.
/// \param heights      the scene's, void = NaN
/// \param undulations  the scene's
Result<MetricRasters> load_metrics(const Scene& scene, const Raster<float>& heights,
                                   const UndulationGrid& undulations);

}  // namespace relevo::lod
