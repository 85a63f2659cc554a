#pragma once

#include "geo/frame.hpp"
#include "geo/geoid.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::lod {

/// The geoid's undulation N at the posts of a grid, bilinear between nodes every 2^k posts: fast enough for
/// every vertex of every frame. The nodes are so close that it differs from the geoid's spline by at most
/// kMaxErrorM; where posts are farther apart than that needs, every post is a node and the difference is the
/// rounding of nodes, 0.016 mm.
class UndulationGrid {
  public:
    static constexpr double kMaxErrorM = 1e-4;

    /// No undulation anywhere: heights above the ellipsoid.
    UndulationGrid() = default;

    /// Covers the frame's padded grid; the error is bounded over the data.
    UndulationGrid(const geo::Geoid& geoid, const geo::GridFrame& frame);

    /// From stored nodes: a node every 2^shift posts.
    UndulationGrid(Raster<float> nodes, int shift);

    /// N at a post, metres. \pre 0 <= column, row < padded_side
    double at(int column, int row) const;

    /// N at a place between posts, metres. \pre inside the padded grid
    double at(geo::GridPosition place) const;

    const Raster<float>& nodes() const { return nodes_; }
    int shift() const { return shift_; }

  private:
    Raster<float> nodes_;
    int shift_ = 0;
    double cells_per_post_ = 1;  // 2^-shift
};

}  // namespace relevo::lod
