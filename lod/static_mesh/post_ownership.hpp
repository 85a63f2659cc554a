#pragma once

#include "lod/static_mesh/grid_triangle.hpp"
#include "lod/static_mesh/ground_cells.hpp"

namespace relevo::lod {

/// Of the triangles of a mesh that a post touches, exactly one owns it: the one that a step from the post
/// leads into, a tiny one along the row with a far tinier one along the column, into the first cell that is
/// ground of those to the south-east, south-west, north-west and north-east. \pre the post is in the triangle
/// or on its edges, which face up
inline bool owns(const PostTriangle& t, const GridPoint& post, const GroundCells& cells) {
    int east = 1;
    int south = 1;
    if (!cells.is_ground(post.column, post.row)) {
        if (cells.is_ground(post.column - 1, post.row)) {
            east = -1;
        } else if (cells.is_ground(post.column - 1, post.row - 1)) {
            east = south = -1;
        } else {
            south = -1;
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const GridPoint& a = t[i];
        const GridPoint& b = t[(i + 1) % 3];
        if (turn(a, b, post) > 0) continue;
        const GridPoint beside{post.column + east, post.row};
        const GridPoint below{post.column, post.row + south};
        const auto along_row = turn(a, b, beside);
        if (along_row < 0 || (along_row == 0 && turn(a, b, below) < 0)) return false;
    }
    return true;
}

}  // namespace relevo::lod
