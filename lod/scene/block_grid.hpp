#pragma once

#include <algorithm>
#include <cassert>

#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// How a raster is cut into blocks of SceneInfo::kBlockSide samples. Blocks do not overlap.
struct BlockGrid {
    struct Box {
        int column = 0;  ///< of the first sample
        int row = 0;
        int columns = 0;
        int rows = 0;
    };

    int columns = 0;  ///< samples
    int rows = 0;
    int across = 0;  ///< blocks
    int down = 0;

    /// Blocks of heights: those at the right and bottom edge are as small as the data leaves them.
    static BlockGrid of_heights(int columns, int rows) {
        constexpr int side = SceneInfo::kBlockSide;
        return {columns, rows, (columns + side - 1) / side, (rows + side - 1) / side};
    }

    /// Blocks of metrics: the padded grid has 2^n + 1 samples a side, and the last blocks take the one that
    /// is over.
    static BlockGrid of_metrics(int padded_side) {
        const int count = std::max(1, padded_side / SceneInfo::kBlockSide);
        return {padded_side, padded_side, count, count};
    }

    /// Posts a side of the cells between the posts of the lattice (soar/metrics.hpp).
    static constexpr int kLatticeSpacing = 8;

    /// Blocks of the metrics of the lattice: every 8th post of the padded grid, blocks likewise.
    static BlockGrid of_lattice(int padded_side) {
        return of_metrics((padded_side - 1) / kLatticeSpacing + 1);
    }

    int count() const { return across * down; }

    Box box(int block_column, int block_row) const {
        assert(block_column >= 0 && block_column < across && block_row >= 0 && block_row < down);
        constexpr int side = SceneInfo::kBlockSide;
        const int right = block_column + 1 == across ? columns : (block_column + 1) * side;
        const int bottom = block_row + 1 == down ? rows : (block_row + 1) * side;
        return {block_column * side, block_row * side, right - block_column * side,
                bottom - block_row * side};
    }
};

/// The samples of a raster in a box, as far as the raster goes: smaller than the box, or empty, beyond its
/// right and bottom edge.
template <class T>
Raster<T> part_of(const Raster<T>& raster, const BlockGrid::Box& box) {
    Raster<T> part(std::clamp(raster.columns() - box.column, 0, box.columns),
                   std::clamp(raster.rows() - box.row, 0, box.rows));
    if (part.columns() == 0) return part;
    for (int row = 0; row < part.rows(); ++row)
        std::copy_n(raster.row(box.row + row) + box.column, part.columns(), part.row(row));
    return part;
}

/// The inverse: puts samples into a raster, the first at the box's corner.
template <class T>
void paste(const Raster<T>& part, const BlockGrid::Box& box, Raster<T>& into) {
    for (int row = 0; row < part.rows(); ++row)
        std::copy_n(part.row(row), part.columns(), into.row(box.row + row) + box.column);
}

}  // namespace relevo::lod
