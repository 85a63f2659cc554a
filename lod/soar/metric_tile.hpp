#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "geo/post_positions.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/raster.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/soar/vertex_lanes.hpp"
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

/// Positions of the posts in a window of the padded grid, as far as metrics of one tile need them: ECEF,
/// metres.
///
/// Metrics are computed of many vertices at once, and the vertices of a level are 2s posts apart. So a row is
/// not kept column by column but *class* by class: a class is every 16th column, one lane after the other,
/// and the neighbours of consecutive lanes at any offset are consecutive lanes too. (16 = 4s for the largest
/// s of fine vertices: the diamonds of a class all look the same.) Posts beyond the window are NaN.
class MetricTile {
  public:
    using Box = BlockGrid::Box;

    /// Posts around a tile that its vertices' metrics may depend on: the diamonds of all descendants of a
    /// vertex with half size s reach at most 3 s, and s is at most 4 (see FineMetrics).
    static constexpr int kHalo = 12;
    static constexpr int kClasses = 16;
    static constexpr int kMostColumns = kClasses * (kMostLanes - 2);

    /// The tile with its halo, cut at the grid's border.
    static Box window_of(const Box& tile, int padded_side, int halo = kHalo);

    MetricTile() = default;

    /// \param heights  H of the data in the window (at most: data ends where the frame's columns and rows
    /// do), void = NaN
    /// \pre the window has at most kMostColumns columns
    MetricTile(const MeshGround& ground, const Box& window, const Raster<float>& heights) {
        begin(ground, window, heights);
        place_until(window.row + window.rows);
    }

    /// \param filled  the same, with heights for voids and padding (MeshHeights)
    MetricTile(const geo::PostPositions& positions, const UndulationGrid& undulations, const Box& window,
               const Raster<float>& heights, const Raster<float>& filled) {
        begin(positions, undulations, window, heights, filled);
        place_until(window.row + window.rows);
    }

    /// Another window, of which no row is placed yet; memory is used again.
    /// \pre all arguments outlive placing
    void begin(const MeshGround& ground, const Box& window, const Raster<float>& heights);
    void begin(const geo::PostPositions& positions, const UndulationGrid& undulations, const Box& window,
               const Raster<float>& heights, const Raster<float>& filled);

    /// Places the rows before `end`, so that work can follow while they are in the processor's cache. Of
    /// those after it nothing below may be asked.
    void place_until(int end);
    int placed_end() const { return placed_end_; }

    const Box& window() const { return window_; }
    bool any_valid() const { return any_valid_; }
    bool all_valid() const { return all_valid_; }
    /// Of the window's part of some rows.
    bool all_valid(int first_row, int last_row) const;

    /// \pre the post is in the window; as for is_valid
    glm::dvec3 position(const GridPoint& p) const {
        const auto i = static_cast<std::size_t>(index(p));
        return {x_[i], y_[i], z_[i]};
    }
    bool is_valid(const GridPoint& p) const {
        return all_valid_ || hole_[static_cast<std::size_t>(index(p))] == 0;
    }

    // The lanes, for loops over them.

    int lanes() const { return lanes_; }                ///< a class in a row; a multiple of 4
    int first_column() const { return first_column_; }  ///< of class 0 in lane 0: a multiple of kClasses
    std::size_t samples() const { return x_.size(); }   ///< of a raster with the same layout

    /// Index of a post. \pre at most DiamondPosts::kReach columns beyond the window. Any row: those beyond
    /// the window have one place, where there is nothing.
    std::ptrdiff_t index(const GridPoint& p) const { return row_begin(p.row) + column_offset(p.column); }
    std::ptrdiff_t row_begin(int row) const {
        const int inside = row - window_.row;
        return kSlack + (inside < 0 || inside >= window_.rows ? window_.rows : inside) * row_samples();
    }
    std::ptrdiff_t column_offset(int column) const {
        const int from = column - first_column_ + kClasses;
        return from % kClasses * lanes_ + (from / kClasses - 1);
    }

    /// Of what is around a row of lanes.
    DiamondPosts::Offsets offsets(const GridPoint& first, int reach) const {
        DiamondPosts::Offsets result;
        for (int by = -reach; by <= reach; ++by) {
            const auto i = static_cast<std::size_t>(by + DiamondPosts::kReach);
            result.row[i] = row_begin(first.row + by);
            result.column[i] = column_offset(first.column + by);
        }
        return result;
    }

    Lanes at(std::ptrdiff_t i) const { return {x_.data() + i, y_.data() + i, z_.data() + i}; }
    /// 0 where there is a valid post, else NaN; null where all are valid.
    const double* holes(std::ptrdiff_t i) const { return all_valid_ ? nullptr : hole_.data() + i; }

  private:
    static constexpr std::ptrdiff_t kSlack =
        4;  // lanes may be looked at one before the first or after the last

    std::ptrdiff_t row_samples() const { return static_cast<std::ptrdiff_t>(kClasses) * lanes_; }
    void begin_counted(const geo::PostPositions& positions, const UndulationGrid& undulations,
                       const Box& window, const Raster<float>& heights, const Raster<float>& filled);
    void count_valid(const Box& window, const Raster<float>& heights);
    void place_row(int row);
    void place_lanes(int row);

    Box window_;
    int placed_end_ = 0;
    int first_column_ = 0;
    int lanes_ = 0;
    bool any_valid_ = false;
    bool all_valid_ = true;
    std::vector<int> rows_with_holes_;  // of the window, before its row i
    std::vector<double> x_, y_, z_;
    std::vector<double> hole_;
    const geo::PostPositions* positions_ = nullptr;
    const UndulationGrid* undulations_ = nullptr;
    const Raster<float>* heights_ = nullptr;
    const Raster<float>* filled_ = nullptr;
    Raster<float> own_filled_;
    std::vector<double> height_;             // of one row, h by column
    std::vector<double> by_class_;           // the same, class by class
    std::vector<double> cos_lon_, sin_lon_;  // class by class
};

}  // namespace relevo::lod
