#include "viewer/ground/viewshed_drape.hpp"

#include <algorithm>

namespace relevo::viewer {

namespace {

/// Red, green, blue and alpha, colours times alpha.
std::array<int, 4> colour_of(std::uint8_t seen) {
    switch (seen) {
        case lod::Viewshed::hidden:
            return {16, 16, 20, 110};
        case lod::Viewshed::visible:
            return {53, 112, 47, 150};
        case lod::Viewshed::unknown:
            return {129, 106, 35, 150};
        default:
            return {0, 0, 0, 0};
    }
}

}  // namespace

Result<DrapeTexels> ViewshedDrape::read(const Page& page) const {
    DrapeTexels texels(static_cast<std::size_t>(kPagePosts) * kPagePosts);
    const lod::BlockGrid::Box& box = shed_->box;
    const int step = 1 << page.level;
    const int samples = std::min(step, 4);
    // Around its post, so that coarser texels do not lie beside the finer ones.
    const auto post = [&](int texel, int first, int sample) {
        return (texel + first * kPageCells) * step + (sample * step) / samples - (samples > 1 ? step / 2 : 0);
    };
    const auto colour = [&](int column, int row) -> std::array<int, 4> {
        const int x = column - box.column;
        const int y = row - box.row;
        if (x < 0 || y < 0 || x >= box.columns || y >= box.rows) return {0, 0, 0, 0};
        return colour_of(shed_->posts.at(x, y));
    };
    for (int row = 0; row < kPagePosts; ++row) {
        for (int column = 0; column < kPagePosts; ++column) {
            std::array<int, 4> sum{};
            for (int j = 0; j < samples; ++j) {
                for (int i = 0; i < samples; ++i) {
                    const auto one = colour(post(column, page.column, i), post(row, page.row, j));
                    for (std::size_t k = 0; k < 4; ++k) sum[k] += one[k];
                }
            }
            auto& texel =
                texels[static_cast<std::size_t>(row) * kPagePosts + static_cast<std::size_t>(column)];
            for (std::size_t k = 0; k < 4; ++k)
                texel[k] = static_cast<std::uint8_t>(sum[k] / (samples * samples));
        }
    }
    return texels;
}

}  // namespace relevo::viewer
