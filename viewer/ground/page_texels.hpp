#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viewer/ground/ground_data.hpp"
#include "viewer/ground/page.hpp"

namespace relevo::viewer {

/// A page as it goes into its slot, whatever its data's size: row by row from the north-west.
///
/// Of each post the normal of the surface with its true proportions along the grid's row and up its column
/// (in a geographic grid east and north; around a pole these turn, and could not be filtered), its height,
/// and whether there is one. All are 16-bit and multiplied by the validity (0 or 1), so that filters average
/// valid posts alone. Beyond the data its edge goes on, for the last cells of coarse levels reach over it.
struct PageTexels {
    /// Normal along row and up column; H as height_code.hpp has it; validity.
    using Post = std::array<std::int16_t, 4>;

    /// 255 or 0: is it of the class sea? Is it land no higher than kSeaLevel?
    using Shore = std::array<std::uint8_t, 2>;
    /// Metres: what is higher rises above the sea, whatever rounding makes of its 0 (shaders/shore.glsl).
    static constexpr float kSeaLevel = 0.3F;

    std::vector<Post> posts;          ///< kPagePosts a side
    std::vector<Shore> shore;         ///< likewise; only with has_sea
    std::vector<std::uint8_t> cells;  ///< kPageCells a side: 0 where a corner is void; only with has_voids
};

/// Bytes of a page with the data that the facts say.
std::size_t page_bytes(const GroundFacts& facts);

/// \param posts  what the pyramid has of the page
PageTexels page_texels(const Page& page, const lod::GroundPosts& posts, const geo::GridFrame& frame,
                       const GroundFacts& facts);

}  // namespace relevo::viewer
