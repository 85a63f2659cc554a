#pragma once

#include <functional>
#include <optional>

#include "geo/frame.hpp"
#include "lod/scene/raster.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// Computes both object-space errors and the sphere radii of every vertex of the padded grid
/// (docs/design.md): saturated, nested on the stored codes, rounded up.
///
/// - bounded: largest distance in space, over the valid posts of the vertex's diamond, between the post and
/// the mesh
///   without the vertex, compared at the same grid coordinates;
/// - incremental: distance of the vertex from the middle of the edge that it splits (Lindstrom & Pascucci).
///
/// \param heights  H of the data, metres, void = NaN
MetricRasters build_metrics(const geo::GridFrame& frame, const UndulationGrid& undulations,
                            const Raster<float>& heights);

/// The same; nothing where it was stopped on the way.
/// \param go_on  called after each level with the part done, 0 to 1; says whether to go on
std::optional<MetricRasters> build_metrics(const geo::GridFrame& frame, const UndulationGrid& undulations,
                                           const Raster<float>& heights,
                                           const std::function<bool(double)>& go_on);

}  // namespace relevo::lod
