#include "viewer/ground/page_texels.hpp"

#include <algorithm>
#include <cmath>

#include "viewer/ground/height_code.hpp"

namespace relevo::viewer {

namespace {

constexpr std::size_t kPosts = static_cast<std::size_t>(kPagePosts) * kPagePosts;
constexpr std::size_t kCells = static_cast<std::size_t>(kPageCells) * kPageCells;

/// The last of a page's posts, along a row or a column, that is inside the data.
int last_inside(int page, int level, int data_posts, int page_posts) {
    const int whole = (data_posts - 1) >> level;
    return std::clamp(whole - page * kPageCells, 0, page_posts - 1);
}

}  // namespace

std::size_t page_bytes(const GroundFacts& facts) {
    return kPosts * (sizeof(PageTexels::Post) + (facts.has_sea ? sizeof(PageTexels::Shore) : 0)) +
           (facts.has_voids ? kCells : 0);
}

PageTexels page_texels(const Page& page, const lod::GroundPosts& posts, const geo::GridFrame& frame,
                       const GroundFacts& facts) {
    const int last_column = last_inside(page.column, page.level, frame.columns, posts.heights.columns());
    const int last_row = last_inside(page.row, page.level, frame.rows, posts.heights.rows());
    const HeightCode code = height_code(facts);

    PageTexels made;
    made.posts.resize(kPosts);
    if (facts.has_sea) made.shore.resize(kPosts);
    for (int row = 0; row < kPagePosts; ++row) {
        const int from = std::min(row, last_row);
        const float* heights = posts.heights.row(from);
        const lod::GroundPosts::Normal* normals = posts.normals.row(from);
        PageTexels::Post* out = made.posts.data() + static_cast<std::ptrdiff_t>(row) * kPagePosts;
        for (int column = 0; column <= last_column; ++column) {
            if (std::isnan(heights[column])) continue;
            out[column] = {normals[column][0], normals[column][1],
                           code.of(static_cast<double>(heights[column])), 32767};
        }
        std::fill(out + last_column + 1, out + kPagePosts, out[last_column]);
        if (!facts.has_sea) continue;
        const std::uint8_t* is_sea = posts.is_sea.row(from);
        PageTexels::Shore* shore = made.shore.data() + static_cast<std::ptrdiff_t>(row) * kPagePosts;
        for (int column = 0; column <= last_column; ++column) {
            const bool is_low = is_sea[column] == 0 && heights[column] < PageTexels::kSeaLevel;
            shore[column] = {is_sea[column], static_cast<std::uint8_t>(is_low ? 255 : 0)};
        }
        std::fill(shore + last_column + 1, shore + kPagePosts, shore[last_column]);
    }
    if (!facts.has_voids) return made;
    made.cells.resize(kCells);
    const auto valid = [](const PageTexels::Post& post) { return post[3] != 0; };
    for (int row = 0; row < kPageCells; ++row) {
        const PageTexels::Post* north = made.posts.data() + static_cast<std::ptrdiff_t>(row) * kPagePosts;
        const PageTexels::Post* south = north + kPagePosts;
        std::uint8_t* cells = made.cells.data() + static_cast<std::ptrdiff_t>(row) * kPageCells;
        for (int column = 0; column < kPageCells; ++column) {
            const bool whole = valid(north[column]) && valid(north[column + 1]) && valid(south[column]) &&
                               valid(south[column + 1]);
            cells[column] = whole ? 255 : 0;
        }
    }
    return made;
}

}  // namespace relevo::viewer
