#include "lod/scene/read_box.hpp"

#include <algorithm>

#include "lod/scene/parallel_blocks.hpp"

namespace relevo::lod {

Result<Raster<float>> read_box(const Scene& scene, const BlockGrid::Box& box) {
    const geo::GridFrame& frame = scene.info().frame;
    const BlockGrid grid = BlockGrid::of_heights(frame.columns, frame.rows);
    constexpr int kSide = SceneInfo::kBlockSide;
    const int first_column = box.column / kSide;
    const int first_row = box.row / kSide;
    const int across = (box.column + box.columns - 1) / kSide - first_column + 1;
    const int down = (box.row + box.rows - 1) / kSide - first_row + 1;
    Raster<float> heights(box.columns, box.rows);
    const auto done = for_each_block(across * down, [&](int i) -> Result<void> {
        const int block_column = first_column + i % across;
        const int block_row = first_row + i / across;
        const auto block = scene.read_heights(block_column, block_row);
        if (!block) return block.error();
        const BlockGrid::Box at = grid.box(block_column, block_row);
        const int west = std::max(at.column, box.column);
        const int east = std::min(at.column + at.columns, box.column + box.columns);
        const int north = std::max(at.row, box.row);
        const int south = std::min(at.row + at.rows, box.row + box.rows);
        for (int row = north; row < south; ++row)
            std::copy_n(block->row(row - at.row) + (west - at.column), east - west,
                        heights.row(row - box.row) + (west - box.column));
        return {};
    });
    if (!done) return done.error();
    return heights;
}

}  // namespace relevo::lod
