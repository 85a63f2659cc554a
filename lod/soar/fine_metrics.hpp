#pragma once

#include "lod/scene/raster.hpp"
#include "lod/soar/metric_tile.hpp"

namespace relevo::lod {

/// Half size of the squares of the coarsest vertices whose metrics are built from a tile and its halo alone.
inline constexpr int kFineHalfSize = 4;
static_assert(2 * kFineHalfSize == MeshHeights::kCell, "coarser vertices lie on the lattice");
static_assert(MetricTile::kHalo >= 3 * kFineHalfSize);

// Object-space errors below this are none: rounding of positions at the earth's radius is 1e-9 m.
inline constexpr double kNegligibleM = 1e-8;
// Spheres are nested with this to spare, so that their order survives evaluation in double.
inline constexpr double kRadiusMarginM = 1e-6;

/// Which object-space errors are built (docs/design.md). The incremental one alone is cheaper: posts are not
/// scanned, and the codes of the bounded one stay 0.
enum class ObjectErrors { both, incremental };

/// Nested codes of the fine vertices (half size at most `half_size`, itself at most kFineHalfSize) of a
/// tile's window, and 0 elsewhere; indices are relative to the window. They are right for the vertices of the
/// tile and up to kHalo - 3 half_size posts around it.
MetricRasters fine_metrics(const MetricTile& tile, int levels, int half_size,
                           ObjectErrors errors = ObjectErrors::both);

}  // namespace relevo::lod
