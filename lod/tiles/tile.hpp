#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/post_positions.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// A square of a terrain at one level of detail: what is loaded, kept and refined as one.
struct TileId {
    int level = 0;   ///< its posts are every 2^level-th of the grid
    int column = 0;  ///< in tiles
    int row = 0;

    friend auto operator<=>(const TileId&, const TileId&) = default;
};

/// How a padded grid of 2^n cells a side is cut into tiles. Tiles of a level share their borders. Up to the
/// level at which one tile of kCells cells covers the grid there are 4 tiles to each of the next coarser
/// level; beyond it there is one a level, of half as many cells each time, up to 2 x 2 cells at level n - 1.
struct TileGrid {
    static constexpr int kCells = 64;

    int levels = 1;       ///< n
    int last_column = 0;  ///< of the data
    int last_row = 0;

    explicit TileGrid(const geo::GridFrame& frame)
        : levels(frame.levels()), last_column(frame.columns - 1), last_row(frame.rows - 1) {}

    int cells(int level) const { return std::min(kCells, 1 << (levels - level)); }
    int across(int level) const { return (1 << (levels - level)) / cells(level); }
    TileId root() const { return {levels - 1, 0, 0}; }
    bool contains(const TileId& id) const {
        return id.column >= 0 && id.row >= 0 && id.column < across(id.level) && id.row < across(id.level);
    }
    GridPoint first_post(const TileId& id) const {
        const int posts = cells(id.level) << id.level;
        return {id.column * posts, id.row * posts};
    }
    /// Is there a cell of the data in the tile?
    bool holds_data(const TileId& id) const {
        const GridPoint first = first_post(id);
        return first.column < std::max(last_column, 1) && first.row < std::max(last_row, 1);
    }
    /// \pre id is not the root
    TileId parent(const TileId& id) const {
        const int halved = across(id.level) > 1 ? 2 : 1;
        return {id.level + 1, id.column / halved, id.row / halved};
    }
    /// Children a side: 2, or 1 where a tile has fewer than kCells cells. \pre level > 0
    int children(int level) const { return cells(level) == kCells ? 2 : 1; }
};

/// The vertices that are new at a tile's level (at odd columns or rows of its posts) with all that refinement
/// asks of them, in the order in which it asks. Groups of 4 that lie side by side are together.
class Tile {
  public:
    static constexpr int kLanes = 4;
    struct Lanes {
        float H[kLanes];               ///< metres above the vertical datum
        float N[kLanes];               ///< undulation, metres
        std::uint16_t error[kLanes];   ///< code of the object-space error
        std::uint16_t radius[kLanes];  ///< code of the sphere's radius; 0: nothing valid below
    };

    /// \pre the posts are those of the block that the tile lies in, as pyramid_block says
    Tile(const TileGrid& grid, const TileId& id, const PyramidBlock& block, const VertexPosts& posts,
         const geo::PostPositions& positions, const UndulationGrid& undulations);

    const TileId& id() const { return id_; }

    /// Squares of 2 x 2 cells a side: every one has a vertex at its centre and one on each side.
    int squares() const { return squares_; }

    /// Groups in a row, and in a row of the middles of sides along a column.
    int groups() const { return groups_; }
    int groups_down() const { return groups_down_; }

    /// Of the squares' centres in a row of squares; the next row's follow.
    const Lanes* centres(int row) const { return lanes_.data() + row * groups_; }
    /// Of the middles of sides along a row: `row` from 0 to squares().
    const Lanes* across(int row) const { return lanes_.data() + (squares_ + row) * groups_; }
    /// Of the middles of sides along a column, which lie in a row of squares: one more than there are
    /// squares.
    const Lanes* down(int row) const {
        return lanes_.data() + (2 * squares_ + 1) * groups_ + row * groups_down_;
    }

    /// Where one of the tile's vertices is kept.
    struct Place {
        const Lanes* lanes;
        int lane;
    };
    Place find(const TileGrid& grid, const GridPoint& vertex) const;

    /// Largest code of the errors of a quarter's middles of sides: whose children are in the next finer
    /// tiles. Quarters by row and column; all are the same where a tile has one child.
    std::uint16_t largest_side_error(int column, int row) const {
        return largest_side_error_[static_cast<std::size_t>(2 * row + column)];
    }

    /// A sphere that holds the tile and all that is finer in it: around a post, its radius in metres. 0:
    /// there is nothing valid.
    struct Sphere {
        GridPoint post;
        double H = 0;
        double N = 0;
        double radius_m = 0;
    };
    const Sphere& sphere() const { return sphere_; }

    std::size_t bytes() const { return sizeof(Tile) + lanes_.size() * sizeof(Lanes); }

  private:
    TileId id_;
    int squares_;
    int groups_;
    int groups_down_;
    std::vector<Lanes> lanes_;
    std::array<std::uint16_t, 4> largest_side_error_{};
    Sphere sphere_;
};

/// The block of a pyramid that has a tile's posts.
PyramidBlock pyramid_block(const TileGrid& grid, const TileId& id);

}  // namespace relevo::lod
