#pragma once

#include <vector>

#include "geo/frame.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/raster.hpp"
#include "lod/soar/diamond.hpp"

namespace relevo::lod {

/// Heights for every post of the padded grid where the data has none, for meshes alone: nothing measures
/// these. A void takes the bilinear mean of the valid posts around it (means of 8 x 8 posts, filled from ever
/// coarser ones where there is none), so that triangles which reach into it follow the ground that they
/// leave; padding continues the data's edge. So it is at even columns and rows; at odd ones a post without a
/// height lies in the middle of the edge that it splits (soar/diamond.hpp), so that every second post has all
/// that is needed to fill the others. Where all of the data is whole metres, so are fills at even posts.
///
/// It is built from blocks and keeps 1/64 of the posts, so that a scene of any size has the same fill however
/// it is cut.
class MeshHeights {
  public:
    /// Posts a side of a mean, and between the posts whose heights are kept (the lattice).
    static constexpr int kCell = BlockGrid::kLatticeSpacing;

    explicit MeshHeights(const geo::GridFrame& frame);

    /// Heights of the data, void = NaN, whose first post is at (column, row), multiples of kCell; so are its
    /// sizes unless it reaches the data's edge. Different blocks may come from different threads.
    void add(int column, int row, const Raster<float>& heights);

    /// To be called once when all data is in.
    void finish();

    /// For a post of the padded grid that has no height, at an even column and row. \pre finish() was called;
    /// as for all below
    float fill(int column, int row) const;

    /// Heights of the posts in a box of the padded grid, all of them filled: those in the box's outermost
    /// columns and rows rightly only where these are even or the grid's last.
    /// \param heights  of the data in the box, as far as it goes; void = NaN
    Raster<float> filled(const BlockGrid::Box& box, const Raster<float>& heights) const;

    /// At a post of the padded grid whose column and row are multiples of kCell.
    float lattice(int column, int row) const;

    /// Has the data a height at a post of the lattice?
    bool lattice_is_valid(int column, int row) const;

  private:
    float of_void(int column, int row) const;
    float of_padding(int column, int row) const;

    int columns_;
    int rows_;
    int levels_;
    bool whole_ = true;               // are all heights whole metres?
    Raster<float> means_;             // of cells, centres at kCell * i + 3.5
    Raster<float> lattice_;           // the data's posts at multiples of kCell
    std::vector<float> last_column_;  // of the data, by row
    std::vector<float> last_row_;     // of the data, by column
};

/// Gives posts at an odd column or row that have no height (NaN) the mean of the ends of the edge that they
/// split, as far as these are in the raster. \param first  place of the raster's first post in the padded
/// grid
void fill_odd_posts(const GridPoint& first, int levels, Raster<float>& heights);

/// All of them at once: heights of the whole padded grid. \param heights  of the data, metres, void = NaN
Raster<float> mesh_heights(const geo::GridFrame& frame, const Raster<float>& heights);

}  // namespace relevo::lod
