#include "lod/pyramid/whole_grid.hpp"

#include "lod/scene/parallel_blocks.hpp"

namespace relevo::lod {

Result<VertexCodes> gather_codes(const Pyramid& pyramid, ErrorMetric metric) {
    const int side = pyramid.frame().padded_side();
    VertexCodes all{Raster<std::uint16_t>(side, side), Raster<std::uint16_t>(side, side)};
    const int top = pyramid.top();
    for (int level = top; level >= 0; --level) {
        const int cells = (side - 1) >> level;  // of the level's grid
        const int block_cells = std::min(cells, Pyramid::kBlockCells);
        const int across = cells / block_cells;
        const auto done = for_each_block(across * across, [&](int i) -> Result<void> {
            const PyramidBlock block{level, i % across, i / across};
            const auto posts = pyramid.read_vertices(block, metric);
            if (!posts) return posts.error();
            // Of shared borders the one that lies further right or down, so that threads write to different
            // posts.
            const int columns = block.column + 1 == across ? block_cells + 1 : block_cells;
            const int rows = block.row + 1 == across ? block_cells + 1 : block_cells;
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    if (level < top && column % 2 == 0 && row % 2 == 0) continue;
                    const int x = (block.column * block_cells + column) << level;
                    const int y = (block.row * block_cells + row) << level;
                    all.error.at(x, y) = posts->error.at(column, row);
                    all.radius.at(x, y) = posts->radius.at(column, row);
                }
            }
            return {};
        });
        if (!done) return done.error();
    }
    return all;
}

}  // namespace relevo::lod
