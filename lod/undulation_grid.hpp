#pragma once

#include <memory>

#include "geo/frame.hpp"
#include "geo/geoid.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::lod {

/// The geoid's undulation N at the posts of a grid, fast enough for every vertex of every frame: bilinear
/// between nodes every 2^k posts, so close that it differs from the geoid's spline by at most kMaxErrorM.
/// Where posts are so far apart that this takes more than kMostNodes, N is the spline itself, which takes
/// longer and no memory.
class UndulationGrid {
  public:
    static constexpr double kMaxErrorM = 1e-4;
    static constexpr int kMostNodes = 1 << 21;  // 8 MiB

    /// No undulation anywhere: heights above the ellipsoid.
    UndulationGrid() = default;

    /// Covers the frame's padded grid; the error is bounded over the data. None for no geoid.
    UndulationGrid(std::shared_ptr<const geo::Geoid> geoid, const geo::GridFrame& frame);

    /// N at a post, metres. \pre 0 <= column, row < padded_side
    double at(int column, int row) const;

    /// Adds N to the heights of consecutive posts of a row: the same as at() of each, sooner.
    void add_row(int column, int row, int count, double* heights_m) const;

    /// N at a place between posts, metres. \pre inside the padded grid
    double at(geo::GridPosition place) const;

    /// Between places 2^shift posts apart N is even: nodes, or parts of the geoid's own cells.
    int shift() const { return shift_; }

    std::uint64_t memory_bytes() const { return nodes_.samples().size() * sizeof(float); }

  private:
    Raster<float> nodes_;                      // empty: the spline itself
    std::shared_ptr<const geo::Geoid> geoid_;  // null: none
    geo::GridFrame frame_;
    int shift_ = 0;
    double cells_per_post_ = 1;  // 2^-shift
};

}  // namespace relevo::lod
