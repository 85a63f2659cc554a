#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "geo/frame.hpp"
#include "lod/soar/diamond.hpp"

namespace relevo::lod {

/// The four sides of a node.
enum class Side { west, east, north, south };
inline constexpr int kSides = 4;

/// A node of the quadtree over the padded grid. Leaves, of level 0, are of kLeafCells cells a side and share
/// their borders; a node of level k has four of level k - 1.
struct ChunkId {
    int level = 0;
    int column = 0;  ///< in nodes of its level
    int row = 0;

    static constexpr int kLeafCells = 32;

    int cells() const { return kLeafCells << level; }
    GridPoint first() const { return {column * cells(), row * cells()}; }
    ChunkId child(int i) const { return {level - 1, 2 * column + (i & 1), 2 * row + (i >> 1)}; }
    ChunkId parent() const { return {level + 1, column >> 1, row >> 1}; }
    /// Its place among its parent's children: child(i).
    std::size_t sibling() const { return static_cast<std::size_t>((column & 1) + 2 * (row & 1)); }

    /// The node of the same level across a side. It may lie outside the grid.
    ChunkId beside(Side side) const {
        ChunkId other = *this;
        if (side == Side::west) --other.column;
        if (side == Side::east) ++other.column;
        if (side == Side::north) --other.row;
        if (side == Side::south) ++other.row;
        return other;
    }

    friend auto operator<=>(const ChunkId&, const ChunkId&) = default;
};

/// The level of the root: one node that is the padded grid. Grids smaller than a leaf have none.
inline int top_chunk_level(const geo::GridFrame& frame) {
    return frame.levels() - 5;
}

/// Has the node a cell of the data?
inline bool has_data(const ChunkId& chunk, const geo::GridFrame& frame) {
    const GridPoint first = chunk.first();
    return first.column < std::max(frame.columns - 1, 1) && first.row < std::max(frame.rows - 1, 1);
}

}  // namespace relevo::lod
