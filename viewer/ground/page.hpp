#pragma once

#include <cstddef>
#include <cstdint>

#include "lod/pyramid/pyramid.hpp"

namespace relevo::viewer {

/// A page of the ground's textures is a block of the pyramid: squares of one level's posts that share their
/// borders, so that bilinear filters need no other posts.
using Page = lod::PyramidBlock;

inline constexpr int kPageCells = lod::Pyramid::kBlockCells;
inline constexpr int kPageShift = 8;  ///< log2 of it
inline constexpr int kPagePosts = kPageCells + 1;
static_assert(kPageCells == 1 << kPageShift);

struct PageHash {
    std::size_t operator()(const Page& page) const {
        const auto key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(page.column)) << 32 |
                         static_cast<std::uint64_t>(static_cast<std::uint32_t>(page.row)) << 5 |
                         static_cast<std::uint64_t>(page.level);
        return static_cast<std::size_t>((key ^ (key >> 29)) * 0x9e3779b97f4a7c15u);
    }
};

/// Has the page a cell of the data? (A grid of one row or column has none, and its first pages count.)
inline bool has_data(const Page& page, const geo::GridFrame& frame) {
    const auto first = [&](int at) { return static_cast<std::int64_t>(at) << (kPageShift + page.level); };
    return (page.column == 0 || first(page.column) < frame.columns - 1) &&
           (page.row == 0 || first(page.row) < frame.rows - 1);
}

}  // namespace relevo::viewer
