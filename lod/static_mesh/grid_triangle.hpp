#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

/// Twice the area of the triangle a, b, c in posts squared; positive where it is counter-clockwise seen from
/// above (columns run east, rows south).
inline std::int64_t turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return std::int64_t{c.column - a.column} * (b.row - a.row) -
           std::int64_t{b.column - a.column} * (c.row - a.row);
}

/// A triangle between posts.
using PostTriangle = std::array<GridPoint, 3>;

/// A triangle of longest-edge bisection: right-angled and isosceles. Its longest edge, from left to right, is
/// along a row, a column or a diagonal; a triangle that is split is so between its apex and the middle of
/// that edge. See soar/diamond.hpp for how they fit together.
struct BisectionTriangle {
    GridPoint left;
    GridPoint right;
    GridPoint apex;

    GridPoint middle() const { return midpoint(left, right); }
    BisectionTriangle left_half() const { return {apex, left, middle()}; }
    BisectionTriangle right_half() const { return {right, apex, middle()}; }

    /// Half a cell: it has no post but its corners, and is never split.
    bool is_finest() const { return std::abs(turn(left, right, apex)) == 1; }
};

/// The part of a triangle inside the posts [0, columns - 1] x [0, rows - 1], as triangles that face up. All
/// their corners are posts, since edges run along rows, columns and diagonals.
struct InnerPart {
    std::array<PostTriangle, 3> triangles{};
    int count = 0;

    const PostTriangle* begin() const { return triangles.data(); }
    const PostTriangle* end() const { return triangles.data() + count; }
};
InnerPart inner_part(const BisectionTriangle& triangle, int columns, int rows);

}  // namespace relevo::lod
