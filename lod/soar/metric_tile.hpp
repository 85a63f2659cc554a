#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "geo/post_positions.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/raster.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// What places the posts of a scene in space, for meshes and their metrics.
struct MeshGround {
    const geo::GridFrame& frame;
    const geo::PostPositions& positions;
    const UndulationGrid& undulations;
    const MeshHeights& fill;

    /// Of a post whose column and row are multiples of MeshHeights::kCell, ECEF, metres.
    glm::dvec3 lattice_position(const GridPoint& p) const {
        const double H = static_cast<double>(fill.lattice(p.column, p.row));
        return positions.at(p.column, p.row, H + undulations.at(p.column, p.row));
    }
};

/// A triangle of the hierarchy: corners in the grid and in space.
struct Triangle {
    GridPoint corner[3];
    glm::dvec3 position[3];
};

/// The largest distance between a surface and the valid posts under it.
struct Deviation {
    double max_m2 = -1;  ///< squared; negative: no valid post

    bool any_post() const { return max_m2 >= 0; }
    void join(const Deviation& other) { max_m2 = other.max_m2 > max_m2 ? other.max_m2 : max_m2; }
};

/// Positions of the posts in a window of the padded grid, as far as metrics of one tile need them: columns of
/// x, y and z (ECEF, metres) that a loop can run over.
class MetricTile {
  public:
    using Box = BlockGrid::Box;

    /// Posts around a tile that its vertices' metrics may depend on: the diamonds of all descendants of a
    /// vertex with half size s reach at most 3 s, and s is at most 4 (see FineMetrics).
    static constexpr int kHalo = 12;

    /// The tile with its halo, cut at the grid's border.
    static Box window_of(const Box& tile, int padded_side, int halo = kHalo);

    /// \param heights  H of the data in the window (at most: data ends where the frame's columns and rows
    /// do), void = NaN
    MetricTile(const MeshGround& ground, const Box& window, const Raster<float>& heights);

    /// \param filled  the same, with heights for voids and padding (MeshHeights)
    MetricTile(const geo::PostPositions& positions, const UndulationGrid& undulations, const Box& window,
               const Raster<float>& heights, const Raster<float>& filled);

    const Box& window() const { return window_; }
    bool any_valid() const { return any_valid_; }
    bool all_valid() const { return all_valid_; }

    /// \pre the post is in the window; as for all below
    glm::dvec3 position(const GridPoint& p) const {
        const std::size_t i = index(p.column, p.row);
        return {x_[i], y_[i], z_[i]};
    }
    bool is_valid(const GridPoint& p) const { return hole_[index(p.column, p.row)] == 0; }

    /// The triangle's plane against every valid post of the data in it and in the box, borders included,
    /// compared at the same grid coordinates.
    Deviation deviation(const Triangle& triangle, const Box& box) const;

  private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row - window_.row) * static_cast<std::size_t>(window_.columns) +
               static_cast<std::size_t>(column - window_.column);
    }

    Box window_;
    bool any_valid_ = false;
    bool all_valid_ = true;
    std::vector<double> x_, y_, z_;
    std::vector<double> hole_;  // 0 where there is a valid post, else NaN
};

}  // namespace relevo::lod
