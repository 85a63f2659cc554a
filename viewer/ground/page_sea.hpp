#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viewer/ground/page.hpp"

namespace relevo::viewer {

/// What parts of a page have sea, and what parts land: squares of kPartCells cells, borders included.
struct PageSea {
    static constexpr int kPartCells = 4;
    static constexpr int kParts = kPageCells / kPartCells;  ///< along a side

    struct Part {
        bool sea = false;
        bool land = false;
    };
    std::array<Part, std::size_t{kParts} * kParts> parts;
    Part all;

    const Part& at(int column, int row) const {
        return parts[static_cast<std::size_t>(row * kParts + column)];
    }
};

/// \param is_sea  a page's posts: not 0 where there is sea; empty: nowhere
PageSea page_sea(const std::vector<std::uint8_t>& is_sea);

}  // namespace relevo::viewer
