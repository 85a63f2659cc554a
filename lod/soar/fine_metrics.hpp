#pragma once

#include <vector>

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

/// Nested metrics of the fine vertices in a tile's window: those with half size at most `half_size`, itself
/// at most kFineHalfSize. They are right for the vertices of the tile and up to kHalo - 3 half_size posts
/// around it.
class FineMetrics {
  public:
    /// Memory is used again. \pre the tile outlives what is asked below
    void begin(const MetricTile& tile, int levels, int half_size, ObjectErrors errors);

    /// Builds all that the tile's placed rows allow.
    void build_placed();

    /// Codes of the posts in a box, 0 of those that are no fine vertices. \pre in the window
    MetricRasters codes(const BlockGrid::Box& box) const;

    // Of one fine vertex, metres, rounded up to what has a code.

    float bounded(const GridPoint& v) const { return values_of_bounded(v)[at(v)]; }
    float incremental(const GridPoint& v) const { return incremental_[at(v)]; }
    float radius(const GridPoint& v) const { return radius_[at(v)]; }  ///< 0: no valid post below

  private:
    std::size_t at(const GridPoint& v) const { return static_cast<std::size_t>(tile_->index(v)); }
    /// With s = 1 both errors are the same: no post lies between a vertex, its children and their edges.
    const std::vector<float>& values_of_bounded(const GridPoint& v) const {
        return (v.column | v.row) % 2 == 0 ? bounded_ : incremental_;
    }
    void build_row(int row, int level, int s);
    void build_lanes(const GridPoint& first, int level, int s);
    void finish_last_level_lanes(const GridPoint& first, const DiamondShape& shape);
    void cut(const BlockGrid::Box& box, const std::vector<float>& even, const std::vector<float>& odd,
             Raster<std::uint16_t>& into) const;

    const MetricTile* tile_ = nullptr;
    int coarse_ = 1;  // posts at multiples of this are no fine vertices
    int levels_ = 0;
    bool with_bounded_ = false;
    std::vector<int> built_end_;                         // of the rows, by level
    std::vector<float> bounded_, incremental_, radius_;  // laid out as the tile
};

/// The codes of the whole window.
MetricRasters fine_metrics(const MetricTile& tile, int levels, int half_size,
                           ObjectErrors errors = ObjectErrors::both);

}  // namespace relevo::lod
