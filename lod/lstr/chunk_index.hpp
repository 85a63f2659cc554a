#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geo/frame.hpp"
#include "lod/lstr/chunk_id.hpp"

namespace relevo::lod {

/// Numbers the nodes of level 1 and coarser that hold data: level by level, row by row.
class ChunkIndex {
  public:
    explicit ChunkIndex(const geo::GridFrame& frame) {
        for (int level = 1; level <= top_chunk_level(frame); ++level) {
            const int cells = ChunkId{level, 0, 0}.cells();
            const auto across = [&](int posts) { return (std::max(posts - 1, 1) + cells - 1) / cells; };
            levels_.push_back({across(frame.columns), across(frame.rows), size_});
            size_ += static_cast<std::size_t>(levels_.back().columns) *
                     static_cast<std::size_t>(levels_.back().rows);
        }
    }

    std::size_t size() const { return size_; }

    /// Not there, has(), where the grid is smaller than two leaves.
    ChunkId root() const { return {static_cast<int>(levels_.size()), 0, 0}; }

    bool has(const ChunkId& id) const {
        if (id.level < 1 || static_cast<std::size_t>(id.level) > levels_.size()) return false;
        const Level& level = of(id.level);
        return id.column >= 0 && id.row >= 0 && id.column < level.columns && id.row < level.rows;
    }
    /// \pre has(id)
    std::size_t place(const ChunkId& id) const {
        const Level& level = of(id.level);
        return level.first + static_cast<std::size_t>(id.row) * static_cast<std::size_t>(level.columns) +
               static_cast<std::size_t>(id.column);
    }
    /// Calls visit(ChunkId) for all, in the order of their numbers.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (int level = 1; static_cast<std::size_t>(level) <= levels_.size(); ++level) {
            for (int row = 0; row < of(level).rows; ++row) {
                for (int column = 0; column < of(level).columns; ++column) visit(ChunkId{level, column, row});
            }
        }
    }

  private:
    struct Level {
        int columns;
        int rows;
        std::size_t first;
    };
    const Level& of(int level) const { return levels_[static_cast<std::size_t>(level) - 1]; }

    std::vector<Level> levels_;
    std::size_t size_ = 0;
};

}  // namespace relevo::lod
