#include "lod/soar/stored_metrics.hpp"

#include <array>

#include "geo/post_positions.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/soar/fine_metrics.hpp"

namespace relevo::lod {

namespace {

using Codes = Raster<std::uint16_t>;

constexpr int kStoredStep = 2;
constexpr std::array kLayers{&MetricRasters::bounded, &MetricRasters::incremental, &MetricRasters::radius};

MetricRasters empty_metrics(int columns, int rows) {
    return {Codes(columns, rows), Codes(columns, rows), Codes(columns, rows)};
}

/// \pre the box begins at even posts
void join_stored(const Codes& stored, const BlockGrid::Box& box, Codes& all) {
    for (int row = 0; row < stored.rows(); ++row) {
        for (int column = 0; column < stored.columns(); ++column)
            all.at(box.column + kStoredStep * column, box.row + kStoredStep * row) = stored.at(column, row);
    }
}

void join_lattice(const Codes& lattice, Codes& all) {
    constexpr int step = BlockGrid::kLatticeSpacing;
    for (int row = 0; row < lattice.rows(); ++row) {
        for (int column = 0; column < lattice.columns(); ++column) {
            // Where there are no coarse vertices (grids of up to 9 posts a side), the lattice says nothing.
            if (const std::uint16_t code = lattice.at(column, row); code != 0)
                all.at(step * column, step * row) = code;
        }
    }
}

/// Codes of the vertices that are not stored: at odd columns or rows.
void join_derived(const Codes& derived, const BlockGrid::Box& window, const BlockGrid::Box& tile,
                  Codes& all) {
    for (int row = tile.row; row < tile.row + tile.rows; ++row) {
        const std::uint16_t* from = derived.row(row - window.row) + (tile.column - window.column);
        std::uint16_t* to = all.row(row) + tile.column;
        for (int i = row % 2 == 0 ? 1 : 0; i < tile.columns; i += row % 2 == 0 ? 2 : 1) to[i] = from[i];
    }
}

}  // namespace

MetricRasters stored_part(const MetricRasters& tile) {
    MetricRasters part =
        empty_metrics((tile.radius.columns() + 1) / kStoredStep, (tile.radius.rows() + 1) / kStoredStep);
    for (const auto layer : kLayers) {
        Codes& to = part.*layer;
        for (int row = 0; row < to.rows(); ++row) {
            for (int column = 0; column < to.columns(); ++column)
                to.at(column, row) = (tile.*layer).at(kStoredStep * column, kStoredStep * row);
        }
    }
    return part;
}

Result<MetricRasters> load_metrics(const Scene& scene, const Raster<float>& heights,
                                   const UndulationGrid& undulations) {
    const geo::GridFrame& frame = scene.info().frame;
    const auto lattice = scene.read_lattice();
    if (!lattice) return lattice.error();

    const geo::PostPositions positions(frame);
    MeshHeights fill(frame);
    fill.add(0, 0, heights);
    fill.finish();
    const MeshGround ground{frame, positions, undulations, fill};
    const int side = frame.padded_side();
    const BlockGrid grid = BlockGrid::of_metrics(side);
    MetricRasters all = empty_metrics(side, side);
    const Result<void> done = for_each_block(grid.count(), [&](int i) -> Result<void> {
        const int block_column = i % grid.across;
        const int block_row = i / grid.across;
        const auto stored = scene.read_metrics(block_column, block_row);
        if (!stored) return stored.error();
        const BlockGrid::Box tile = grid.box(block_column, block_row);
        for (const auto layer : kLayers) join_stored((*stored).*layer, tile, all.*layer);

        const BlockGrid::Box window = MetricTile::window_of(tile, side, 3);
        const MetricTile posts(ground, window, part_of(heights, window));
        if (!posts.any_valid()) return {};
        const MetricRasters derived = fine_metrics(posts, frame.levels(), 1);
        for (const auto layer : kLayers) join_derived(derived.*layer, window, tile, all.*layer);
        return {};
    });
    if (!done) return done.error();
    for (const auto layer : kLayers) join_lattice((*lattice).*layer, all.*layer);
    if (!scene.info().bounded_errors) all.bounded = Codes(side, side);
    return all;
}

}  // namespace relevo::lod
