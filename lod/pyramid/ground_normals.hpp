#pragma once

#include <cstdint>
#include <optional>

#include "geo/frame.hpp"
#include "geo/polar_positions.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/scene/block_grid.hpp"
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
    Raster<GroundPosts::Normal> of(const BlockGrid::Box& box, const Raster<float>& around) const;

  private:
    geo::GridFrame frame_;
    std::optional<geo::PolarPositions> polar_;
};

/// What pictures need of some posts besides their heights.
struct Ground {
    Raster<GroundPosts::Normal> normals;
    Raster<std::uint8_t> classes;  ///< PostClass

    Ground() = default;
    Ground(int columns, int rows) : normals(columns, rows), classes(columns, rows) {}
};

/// Every second post of a level in both directions: its class, and the mean of the normals at it and at the
/// eight posts around it, as far as they are valid, with the weights [1 2 1] x [1 2 1]. 0 at voids.
/// \param box  of posts to take: its column and row are of the first one in `fine`, its columns and rows say
/// how many. What lies around `fine` counts as void
Ground every_second(const Ground& fine, const BlockGrid::Box& box);

}  // namespace relevo::lod
