#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "geo/frame.hpp"
#include "geo/polar_positions.hpp"
#include "geo/result.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/level_block.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::lod {

/// Normals of the surface at the posts of a grid, from the heights around them: central differences over the
/// distances on the ground, one-sided beside voids and the data's border, in the grid's own directions.
class GroundNormals {
  public:
    explicit GroundNormals(const geo::GridFrame& frame);

    /// Normals at the posts of a box; 0 where they have no height.
    /// \param around  heights of the box and of one post more to each side, NaN where there is none. In a
    /// grid that closes, beyond the last column lies the second, and beyond the first the last but one
    Raster<Ground::Normal> of(const BlockGrid::Box& box, const Raster<float>& around) const;

  private:
    geo::GridFrame frame_;
    std::optional<geo::PolarPositions> polar_;
};

/// Heights of a box of posts of the data and of one post more to each side, as GroundNormals wants them. Of a
/// grid that closes, what lies beyond the seam is read from its other side. \param read  gives
/// Result<Raster<float>>: heights of a box of the data, void = NaN
template <class Read>
Result<Raster<float>> with_border(const geo::GridFrame& frame, const BlockGrid::Box& box, const Read& read) {
    const int left = std::max(box.column - 1, 0);
    const int top = std::max(box.row - 1, 0);
    const int right = std::min(box.column + box.columns + 1, frame.columns);
    const int bottom = std::min(box.row + box.rows + 1, frame.rows);
    Raster<float> around(box.columns + 2, box.rows + 2, std::numeric_limits<float>::quiet_NaN());
    const auto put = [&](const BlockGrid::Box& from, int column) -> Result<void> {
        const auto part = read(from);
        if (!part) return part.error();
        paste(*part, {column - (box.column - 1), top - (box.row - 1), from.columns, from.rows}, around);
        return {};
    };
    if (auto done = put({left, top, right - left, bottom - top}, left); !done) return done.error();
    if (!frame.closes()) return around;
    if (box.column == 0) {
        if (auto done = put({frame.columns - 2, top, 1, bottom - top}, -1); !done) return done.error();
    }
    if (box.column + box.columns == frame.columns) {
        if (auto done = put({1, top, 1, bottom - top}, frame.columns); !done) return done.error();
    }
    return around;
}

/// Every second post of a level in both directions: its class, and the mean of the normals at it and at the
/// eight posts around it, as far as they are valid, with the weights [1 2 1] x [1 2 1]. 0 at voids.
/// \param box  of posts to take: its column and row are of the first one in `fine`, its columns and rows say
/// how many. What lies around `fine` counts as void
Ground every_second(const Ground& fine, const BlockGrid::Box& box);

}  // namespace relevo::lod
