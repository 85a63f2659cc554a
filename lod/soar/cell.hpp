#pragma once

#include <array>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

/// The corners of a finest triangle, counter-clockwise seen from above, its right angle last.
using CellTriangle = std::array<GridPoint, 3>;

/// The two triangles into which the finest level of the hierarchy cuts the cell south-east of a post: along
/// the diagonal between its post of even column and row and its post of odd ones.
inline std::array<CellTriangle, 2> cell_triangles(const GridPoint& cell) {
    const GridPoint north_west = cell;
    const GridPoint north_east{cell.column + 1, cell.row};
    const GridPoint south_west{cell.column, cell.row + 1};
    const GridPoint south_east{cell.column + 1, cell.row + 1};
    const bool falls_east = (cell.column + cell.row) % 2 == 0;
    if (falls_east) return {{{south_east, north_west, south_west}, {north_west, south_east, north_east}}};
    return {{{north_east, south_west, south_east}, {south_west, north_east, north_west}}};
}

}  // namespace relevo::lod
