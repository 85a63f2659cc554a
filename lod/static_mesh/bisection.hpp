#pragma once

#include <vector>

#include "lod/static_mesh/ground_cells.hpp"
#include "lod/static_mesh/post_set.hpp"

namespace relevo::lod {

/// Squares of 2^k cells a side that cover a grid, side by side: the roots of its bisection. k is as small as
/// covers the shorter side, so that a long grid has a row of them. They are halved along diagonals that
/// alternate like a chess board, so that neighbours share all edges.
class BisectionRoots {
  public:
    /// \pre columns, rows >= 2
    BisectionRoots(int columns, int rows);

    /// Posts of the squares: more than the grid's, unless its sides are multiples of 2^k + 1.
    int columns() const { return across_ * side_ + 1; }
    int rows() const { return down_ * side_ + 1; }

    std::vector<BisectionTriangle> triangles() const;

    /// The triangles on both sides of the edge that a post splits: one where the edge is on the border of the
    /// squares. None for their corners, which split no edge.
    struct Sides {
        std::array<BisectionTriangle, 2> triangles{};
        int count = 0;

        const BisectionTriangle* begin() const { return triangles.data(); }
        const BisectionTriangle* end() const { return triangles.data() + count; }
    };
    Sides sides(const GridPoint& split) const;

  private:
    int side_;  // cells
    int across_;
    int down_;
};

/// The posts that split triangles in the coarsest mesh of longest-edge bisection in which no triangle
/// *fails*.
///
/// There is one such mesh, and it is part of every other: a triangle of a mesh that fails must be split in
/// each finer mesh without failures, and with it all that conformity makes it bring along. So splitting what
/// fails, in any order and on any number of threads, until nothing does, ends in the same mesh, and none of
/// the family has fewer triangles.
///
/// A triangle fails if its error at a post exceeds the limit, or if it reaches into cells that are ground and
/// into others. It is judged by its part inside the grid; triangles wholly outside are left as they are.
///
/// \param surface  HeightSurface or SpaceSurface (surface.hpp): the ground and what an error is
template <class Surface>
PostSet choose_splits(const BisectionRoots& roots, const Surface& surface, const GroundCells& cells,
                      double max_error_m);

}  // namespace relevo::lod
