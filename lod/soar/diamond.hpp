#pragma once

#include <array>
#include <cstdlib>

namespace relevo::lod {

// The hierarchy of longest-edge bisection on a grid of 2^n + 1 posts a side.
//
// Vertex levels run from 0 (the grid's centre) to 2n - 1. A vertex of an even level is the centre of a square
// of half size s = 2^(n - 1 - level / 2) and splits one of its diagonals; a vertex of an odd level is the
// middle of a square's side and splits that side. Its diamond is the square, or the square turned by 45
// degrees around it: the triangles that meet at it when it is drawn. The corners of the grid have no level:
// they are always there.

/// A post of the padded grid.
struct GridPoint {
    int column = 0;
    int row = 0;

    friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

inline GridPoint midpoint(const GridPoint& a, const GridPoint& b) {
    return {(a.column + b.column) / 2, (a.row + b.row) / 2};
}

/// Up to four posts, without allocation.
struct GridPoints {
    std::array<GridPoint, 4> points{};
    int count = 0;

    void add(const GridPoint& point) { points[static_cast<std::size_t>(count++)] = point; }
    const GridPoint* begin() const { return points.data(); }
    const GridPoint* end() const { return points.data() + count; }
};

/// Half the side of the squares of a vertex level, in posts.
inline int half_size(int levels, int level) {
    return 1 << (levels - 1 - level / 2);
}

/// What a vertex of the hierarchy has around it.
struct Diamond {
    GridPoint left;     ///< the edge that the vertex splits runs from left ...
    GridPoint right;    ///< ... to right
    GridPoints apexes;  ///< the other corners of the diamond: two, on the border of the grid one. They are
                        ///< its parents
};

inline Diamond diamond(const GridPoint& v, int level, int levels) {
    const int s = half_size(levels, level);
    const int side = 1 << levels;
    Diamond d;
    if (level % 2 == 0) {
        // One end of the split diagonal is a post of the next coarser squares' corners, a multiple of 4s.
        const auto coarse_end = [s](int centre) {
            return (centre - s) % (4 * s) == 0 ? centre - s : centre + s;
        };
        d.left = {coarse_end(v.column), coarse_end(v.row)};
        d.right = {2 * v.column - d.left.column, 2 * v.row - d.left.row};
        d.apexes.add({d.left.column, d.right.row});
        d.apexes.add({d.right.column, d.left.row});
        return d;
    }
    const bool along_row = v.row % (2 * s) == 0;  // of a horizontal side
    const int dx = along_row ? s : 0;
    const int dy = along_row ? 0 : s;
    d.left = {v.column - dx, v.row - dy};
    d.right = {v.column + dx, v.row + dy};
    for (const int sign : {-1, 1}) {
        const GridPoint apex{v.column + sign * dy, v.row + sign * dx};
        if (apex.column >= 0 && apex.column <= side && apex.row >= 0 && apex.row <= side) d.apexes.add(apex);
    }
    return d;
}

/// The vertices of the next level that need this one: four, on the border of the grid two; at the last level
/// none.
inline GridPoints children(const GridPoint& v, int level, int levels) {
    GridPoints result;
    if (level == 2 * levels - 1) return result;
    const int s = half_size(levels, level);
    const int side = 1 << levels;
    if (level % 2 == 0) {
        result.add({v.column - s, v.row});
        result.add({v.column + s, v.row});
        result.add({v.column, v.row - s});
        result.add({v.column, v.row + s});
        return result;
    }
    for (const int dy : {-s / 2, s / 2}) {
        for (const int dx : {-s / 2, s / 2}) {
            const GridPoint child{v.column + dx, v.row + dy};
            if (child.column > 0 && child.column < side && child.row > 0 && child.row < side)
                result.add(child);
        }
    }
    return result;
}

/// Calls visit(GridPoint) for each vertex of a level in one row of posts; does nothing where the row has
/// none.
template <class Visit>
void for_each_vertex_in_row(int levels, int level, int row, Visit visit) {
    const int s = half_size(levels, level);
    const int side = 1 << levels;
    if (row % s != 0) return;
    const bool odd_row = (row / s) % 2 == 1;
    if (level % 2 == 0) {
        if (!odd_row) return;
        for (int column = s; column < side; column += 2 * s) visit(GridPoint{column, row});
    } else {
        for (int column = odd_row ? 0 : s; column <= side; column += 2 * s) visit(GridPoint{column, row});
    }
}

}  // namespace relevo::lod
