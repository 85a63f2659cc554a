#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ingest/affine.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// A smooth map of places, in place; NaN where it is not defined.
using ExactTransform = std::function<void(std::span<Place>)>;

/// Largest error of an interpolated position, in posts of the grid that it is in.
inline constexpr double kPositionTolerance = 1e-3;

inline constexpr int kTransformTile = 64;

/// A map in a tile of at most kTransformTile posts a side, interpolated: at most `tolerance` away from the
/// exact one at every post.
///
/// The tile is cut into cells with the exact map at their corners and bilinear interpolation inside. For a
/// map with second derivatives f_uu and f_vv the error in a cell of size a x b is at most (a^2 |f_uu| + b^2
/// |f_vv|) / 8 (the mixed term is reproduced), which is what the errors in the middles of two neighbouring
/// edges add up to; these are measured, together with the one at the centre. Twice their sum (room for
/// derivatives that change inside a cell) must be within the tolerance, or the cells are halved, down to
/// single posts, where nothing is interpolated. About 10 exact positions a tile suffice for a UTM zone.
class TileMesh {
  public:
    TileMesh(const ExactTransform& exact, Window tile, double tolerance = kPositionTolerance);

    Window tile() const { return tile_; }

    /// Places of the posts of a row of the tile. \pre 0 <= row < tile().rows, places.size() == tile().columns
    void row(int row, std::span<Place> places) const;

    /// Bounds of all places that there are; left > right where there are none.
    struct Box {
        double left, top, right, bottom;
    };
    Box box() const;
    /// The same of a window of its posts (relative to the tile).
    Box box_of(Window window) const;

    /// Does x depend on the column alone, and y on the row alone, bit for bit?
    bool separable() const;

    /// The cells: columns and rows of their corners, relative to the tile, and the exact places there.
    const std::vector<int>& node_columns() const { return columns_; }
    const std::vector<int>& node_rows() const { return rows_; }
    /// The cell that a column or row of posts of the tile is in.
    int cell_column(int column) const;
    int cell_row(int row) const;

  private:
    void place_corners(const ExactTransform& exact, int step);
    bool close_enough(const ExactTransform& exact, double tolerance) const;

    Window tile_;
    std::vector<int> columns_;
    std::vector<int> rows_;
    lod::Raster<Place> corners_;
};

/// The map at every post of a window, by TileMesh. Tiles lie at multiples of 64 from (0, 0), and a post's
/// result depends on its tile alone: windows that start at such multiples, and end at one or at the grid's
/// edge, agree. \pre window.column and window.row are multiples of kTransformTile
lod::Raster<Place> transform_posts(const ExactTransform& exact, Window window,
                                   double tolerance = kPositionTolerance);

}  // namespace relevo::ingest
