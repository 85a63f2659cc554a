#include "ingest/posts/post_passes.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "ingest/blocks_in_order.hpp"
#include "ingest/posts/fill_voids.hpp"
#include "ingest/sea/sea_bed.hpp"

namespace relevo::ingest {
namespace {

using lod::BlockGrid;

/// A block with posts around it, as far as the data goes.
struct Surroundings {
    BlockGrid::Box all;
    Window inside;  // the block, in `all`
};

Surroundings around(const BlockGrid& grid, const BlockGrid::Box& box, int halo) {
    const int west = std::max(box.column - halo, 0);
    const int north = std::max(box.row - halo, 0);
    const int east = std::min(box.column + box.columns + halo, grid.columns);
    const int south = std::min(box.row + box.rows + halo, grid.rows);
    return {{west, north, east - west, south - north},
            {box.column - west, box.row - north, box.columns, box.rows}};
}

template <class T>
lod::Raster<T> part(const lod::Raster<T>& raster, const Window& inside) {
    return lod::part_of(raster, BlockGrid::Box{inside.column, inside.row, inside.columns, inside.rows});
}

/// Cuts a window out, and says where it lies now.
void cut(lod::Posts& posts, Surroundings& where, const Surroundings& smaller) {
    const Window kept{smaller.all.column - where.all.column, smaller.all.row - where.all.row,
                      smaller.all.columns, smaller.all.rows};
    posts.heights = part(posts.heights, kept);
    posts.marks = part(posts.marks, kept);
    where = smaller;
}

/// Changes the posts of a block. Where voids are filled, outliers around it are replaced too.
Result<void> change(lod::Posts& posts, Surroundings& where, const BlockGrid& grid, const BlockGrid::Box& box,
                    const PostChanges& changes) {
    const Surroundings filled = around(grid, box, changes.fill_width > 0 ? fill_halo(changes.fill_width) : 0);
    if (changes.despike) {
        const Window spiked{filled.all.column - where.all.column, filled.all.row - where.all.row,
                            filled.all.columns, filled.all.rows};
        despike(posts.heights, posts.marks, spiked, 0, 0);
    }
    if (changes.fill_width == 0) return {};
    cut(posts, where, filled);  // beyond it outliers are still there
    const auto done =
        fill_voids(posts.heights, posts.marks, where.inside, changes.fill_width, changes.whole_metres);
    if (!done) return done.error();
    return {};
}

}  // namespace

Result<Outliers> clean_posts(const lod::DraftPosts& raw, const PostChanges& changes, lod::DraftPosts& cleaned,
                             SeaClassifier& sea, const Stage& stage) {
    const BlockGrid& grid = raw.grid();
    const int halo = kOutlierHalo + (changes.fill_width > 0 ? fill_halo(changes.fill_width) : 0);
    std::vector<Outliers> found(static_cast<std::size_t>(grid.count()));
    const auto done = blocks_in_order(grid.count(), stage, [&](int i) -> Result<void> {
        const int column = i % grid.across;
        const int row = i / grid.across;
        const BlockGrid::Box box = grid.box(column, row);
        Surroundings where = around(grid, box, halo);
        auto posts = raw.read(where.all);
        if (!posts) return posts.error();
        found[static_cast<std::size_t>(i)] =
            find_outliers(posts->heights, posts->marks, where.inside, box.column, box.row);
        if (auto changed = change(*posts, where, grid, box, changes); !changed) return changed;
        cut(*posts, where, around(grid, box, 0));
        if (sea.needs_blocks()) sea.add_block(column, row, posts->heights, posts->marks);
        if (cleaned.has(column, row)) return {};
        return cleaned.write(column, row, std::move(*posts));
    });
    if (!done) return done.error();
    Outliers all;
    for (const Outliers& part_of_all : found) all.add(part_of_all);
    return all;
}

Result<lod::Posts> classified_block(const lod::DraftPosts& cleaned, const geo::GridFrame& frame,
                                    const SeaClassifier& sea, int block_column, int block_row) {
    const BlockGrid& grid = cleaned.grid();
    const BlockGrid::Box box = grid.box(block_column, block_row);
    const auto read = cleaned.read(block_column, block_row);
    if (!read) return read.error();
    lod::Posts block = **read;
    const auto modelled = sea.mark_block(block_column, block_row, block.heights, block.marks);
    if (!modelled) return modelled.error();
    if (*modelled == 0) return block;

    const Surroundings where = around(grid, box, kSeaBedHalo);
    auto wide = cleaned.read(where.all);
    if (!wide) return wide.error();
    const BlockGrid::Box inside{where.inside.column, where.inside.row, box.columns, box.rows};
    lod::paste(block.marks, inside, wide->marks);
    model_sea_bed(frame, where.all.column, where.all.row, where.inside, wide->heights, wide->marks);
    block.heights = part(wide->heights, where.inside);
    return block;
}

}  // namespace relevo::ingest
