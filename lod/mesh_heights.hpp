#pragma once

#include <vector>

#include "geo/frame.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::lod {

/// Heights for every post of the padded grid where the data has none, for meshes alone: nothing measures
/// these. A void takes the bilinear mean of the valid posts around it (means of 8 x 8 posts, filled from ever
/// coarser ones where there is none), so that triangles which reach into it follow the ground that they
/// leave; padding continues the data's edge.
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

    /// For a void at a post of the data. \pre finish() was called; as for all below
    float fill(int column, int row) const;

    /// At a post of the padding: not of the data in at least one axis.
    float padding(int column, int row) const;

    /// At a post of the padded grid whose column and row are multiples of kCell.
    float lattice(int column, int row) const;

    /// Has the data a height at a post of the lattice?
    bool lattice_is_valid(int column, int row) const;

  private:
    int columns_;
    int rows_;
    Raster<float> means_;             // of cells, centres at kCell * i + 3.5
    Raster<float> lattice_;           // the data's posts at multiples of kCell
    std::vector<float> last_column_;  // of the data, by row
    std::vector<float> last_row_;     // of the data, by column
};

/// All of them at once: heights of the whole padded grid. \param heights  of the data, metres, void = NaN
Raster<float> mesh_heights(const geo::GridFrame& frame, const Raster<float>& heights);

}  // namespace relevo::lod
