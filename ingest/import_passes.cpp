#include "ingest/import_passes.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <vector>

#include "ingest/blocks_in_order.hpp"
#include "ingest/posts/post_passes.hpp"
#include "ingest/posts/survey.hpp"
#include "lod/pyramid/pyramid_writer.hpp"
#include "lod/soar/metrics.hpp"

namespace relevo::ingest {
namespace {

using lod::BlockGrid;

struct BlockPlace {
    int column;
    int row;
};

BlockPlace place_of(const BlockGrid& grid, int i) {
    return {i % grid.across, i / grid.across};
}

/// The part of a box and of what is around it that the data covers, and where the box is in it.
Window inside_of(const BlockGrid::Box& around, const BlockGrid::Box& box) {
    return {box.column - around.column, box.row - around.row, box.columns, box.rows};
}

bool same_bits(const lod::Raster<float>& a, const lod::Raster<float>& b) {
    return std::memcmp(a.samples().data(), b.samples().data(), a.samples().size() * sizeof(float)) == 0;
}

}  // namespace

void list_outliers(const Outliers& outliers, lod::SceneInfo& info) {
    info.outlier_posts = outliers.count;
    const std::size_t kept = std::min(outliers.largest.size(), lod::SceneInfo::kOutliersKept);
    for (std::size_t i = 0; i < kept; ++i) {
        const Outlier& one = outliers.largest[i];
        info.outliers.push_back(
            {one.column, one.row, static_cast<double>(one.height), static_cast<double>(one.median)});
    }
}

Result<Copied> copy_posts(const Mosaic& mosaic, lod::HeightType type, lod::DraftPosts& posts,
                          SeaClassifier* sea, const Stage& stage) {
    const BlockGrid& grid = posts.grid();
    std::atomic<bool> too_wide = false;
    const auto done = blocks_in_order(grid.count(), stage, [&](int i) -> Result<void> {
        if (too_wide) return {};
        const auto [column, row] = place_of(grid, i);
        const BlockGrid::Box box = grid.box(column, row);
        if (posts.has(column, row)) {
            if (sea == nullptr) return {};
            const auto known = posts.read(column, row);
            if (!known) return known.error();
            sea->add_block(column, row, (*known)->heights, (*known)->marks);
            return {};
        }
        auto read = mosaic.read({box.column, box.row, box.columns, box.rows});
        if (!read) return read.error();
        if (type == lod::HeightType::int16 && !fits_int16(read->heights)) {
            too_wide = true;
            return {};
        }
        if (sea != nullptr) sea->add_block(column, row, read->heights, read->marks);
        return posts.write(column, row, {std::move(read->heights), std::move(read->marks)});
    });
    if (!done) return done.error();
    return too_wide ? Copied::too_wide_for_int16 : Copied::all;
}

Result<void> finish_posts(const lod::DraftPosts& cleaned, const geo::GridFrame& frame,
                          const SeaClassifier& sea, lod::DraftPosts& posts, lod::MeshHeights& fill,
                          const Stage& stage) {
    const BlockGrid& grid = posts.grid();
    const auto done = blocks_in_order(grid.count(), stage, [&](int i) -> Result<void> {
        const auto [column, row] = place_of(grid, i);
        const BlockGrid::Box box = grid.box(column, row);
        if (!posts.has(column, row)) {
            auto block = classified_block(cleaned, frame, sea, column, row);
            if (!block) return block.error();
            const auto before = cleaned.read(column, row);
            if (!before) return before.error();
            const bool share = posts.codes_as(cleaned) && same_bits(block->heights, (*before)->heights);
            const auto written = share ? posts.write_marks(column, row, std::move(*block), cleaned)
                                       : posts.write(column, row, std::move(*block));
            if (!written) return written;
        }
        // As stored, which may differ from what was read where heights are stored with loss.
        const auto stored = posts.read(column, row);
        if (!stored) return stored.error();
        fill.add(box.column, box.row, (*stored)->heights);
        return {};
    });
    if (!done) return done;
    fill.finish();
    return {};
}

Result<void> measure_posts(const lod::DraftPosts& posts, const lod::MeshHeights& fill,
                           const lod::UndulationGrid& undulations, const lod::SceneWriter& writer,
                           bool count_outliers, lod::SceneInfo& info, const Stage& stage) {
    const geo::GridFrame& frame = info.frame;
    const geo::PostPositions positions(frame);
    lod::MetricBuilder metrics({frame, positions, undulations, fill}, info.bounded_errors
                                                                          ? lod::ObjectErrors::both
                                                                          : lod::ObjectErrors::incremental);
    auto pyramid = lod::PyramidWriter::open(writer, frame, info.height_type, fill,
                                            [&](const BlockGrid::Box& box) { return posts.read(box); });
    if (!pyramid) return pyramid.error();
    const int side = frame.padded_side();
    const BlockGrid tiles = BlockGrid::of_metrics(side);
    std::vector<Survey> surveys(static_cast<std::size_t>(tiles.count()));
    std::vector<Outliers> outliers(static_cast<std::size_t>(tiles.count()));
    const auto done = blocks_in_order(tiles.count(), stage, [&](int i) -> Result<void> {
        const auto [column, row] = lod::PyramidWriter::tile_in_order(tiles, i);
        const BlockGrid::Box tile = tiles.box(column, row);
        const BlockGrid::Box window = lod::MetricTile::window_of(tile, side);
        const auto around = posts.read(window);
        if (!around) return around.error();
        const lod::MetricRasters codes = metrics.add_tile(tile, around->heights);
        if (auto written = pyramid->add_tile(column, row, codes); !written) return written;

        Window inside = inside_of(window, tile);
        inside.columns = std::min(inside.columns, around->heights.columns() - inside.column);
        inside.rows = std::min(inside.rows, around->heights.rows() - inside.row);
        if (inside.columns <= 0 || inside.rows <= 0) return {};
        surveys[static_cast<std::size_t>(i)] = Survey(*around, inside);
        if (count_outliers)
            outliers[static_cast<std::size_t>(i)] =
                find_outliers(around->heights, around->marks, inside, tile.column, tile.row);
        return {};
    });
    if (!done) return done;
    Survey all;
    for (const Survey& part : surveys) all.join(part);
    all.put_into(info);
    if (count_outliers) {
        Outliers found;
        for (const Outliers& part : outliers) found.add(part);
        list_outliers(found, info);
    }
    return pyramid->finish(metrics.finish());
}

}  // namespace relevo::ingest
