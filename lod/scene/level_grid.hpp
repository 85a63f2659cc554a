#pragma once

#include <algorithm>

#include "geo/frame.hpp"

namespace relevo::lod {

/// How the levels of a scene's pyramid (pyramid/pyramid.hpp) are cut into blocks: level k has every 2^k-th
/// post of the padded grid, in blocks of kCells cells a side that share their borders.
struct LevelGrid {
    static constexpr int kCells = 256;
    static constexpr int kPosts = kCells + 1;

    /// The coarsest level of a padded grid of 2^levels + 1 posts a side.
    static int top(int levels) { return std::max(levels - 8, 0); }

    /// Blocks of a level, along a row as along a column.
    static int blocks(int levels, int level) { return 1 << std::max(levels - level - 8, 0); }

    /// Posts of the data at a level, along a row or a column that has `posts` of them.
    static int posts_at(int posts, int level) { return ((posts - 1) >> level) + 1; }
};

}  // namespace relevo::lod
