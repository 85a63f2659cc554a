#pragma once

#include "lod/scene/raster.hpp"
#include "lod/static_mesh/grid_triangle.hpp"
#include "lod/static_mesh/post_set.hpp"

namespace relevo::lod {

/// The cells of a grid that are ground: their four posts are valid. A cell goes by its north-west post.
class GroundCells {
  public:
    explicit GroundCells(const Raster<float>& heights);

    /// False outside the grid.
    bool is_ground(int column, int row) const;

    /// How much of the cells that a triangle reaches into is ground; of the part inside the grid.
    enum class Share { none, some, all };
    Share share(const BisectionTriangle& triangle) const;

    /// Posts at a corner of a ground cell: those that a mesh covers.
    std::uint64_t covered_posts() const { return covered_posts_; }
    std::uint64_t count() const { return count_; }

  private:
    int columns_;  // of cells
    int rows_;
    bool all_ = true;  // then no_ground_ is not looked at
    PostSet no_ground_;
    std::uint64_t count_ = 0;
    std::uint64_t covered_posts_ = 0;
};

}  // namespace relevo::lod
