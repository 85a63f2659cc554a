#include "lod/terrain.hpp"

#include <cassert>
#include <limits>
#include <utility>

#include "lod/pyramid/memory_pyramid.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/parallel_blocks.hpp"
#include "lod/soar/stored_metrics.hpp"

namespace relevo::lod {

namespace {

/// 255 at posts that are sea; of no size where there are none.
Result<Raster<std::uint8_t>> read_sea(const Scene& scene, const Raster<float>& heights) {
    if (scene.info().sea_posts == 0) return Raster<std::uint8_t>{};
    Raster<std::uint8_t> sea(heights.columns(), heights.rows());
    const BlockGrid grid = BlockGrid::of_heights(heights.columns(), heights.rows());
    const auto done = for_each_block(grid.count(), [&](int i) -> Result<void> {
        const BlockGrid::Box box = grid.box(i % grid.across, i / grid.across);
        const auto marks = scene.read_marks(i % grid.across, i / grid.across, part_of(heights, box));
        if (!marks) return marks.error();
        for (int row = 0; row < box.rows; ++row) {
            for (int column = 0; column < box.columns; ++column) {
                if (marks->at(column, row).post_class() == PostClass::sea)
                    sea.at(box.column + column, box.row + row) = 255;
            }
        }
        return {};
    });
    if (!done) return done.error();
    return sea;
}

}  // namespace

Terrain::Parts::Parts(std::shared_ptr<const Pyramid> of, UndulationGrid N)
    : pyramid(std::move(of)),
      positions(pyramid->frame()),
      undulations(std::move(N)),
      bounds(lod::level_bounds(pyramid->frame(), undulations)),
      posts(*pyramid) {}

Result<Terrain> Terrain::open(std::shared_ptr<const Pyramid> pyramid, UndulationGrid undulations,
                              ErrorMetric metric, const TileStoreOptions& options) {
    auto parts = std::make_unique<Parts>(std::move(pyramid), std::move(undulations));
    auto tiles = TileStore::open(*parts->pyramid, parts->positions, parts->undulations, metric, options);
    if (!tiles) return tiles.error();
    parts->tiles = std::move(*tiles);
    return Terrain(std::move(parts));
}

Result<Terrain> Terrain::load(const Scene& scene, ErrorMetric metric) {
    auto heights = scene.read_all_heights();
    if (!heights) return heights.error();
    UndulationGrid undulations = scene.undulations();
    auto metrics = load_metrics(scene, *heights, undulations);
    if (!metrics) return metrics.error();
    const auto sea = read_sea(scene, *heights);
    if (!sea) return sea.error();
    return Terrain(scene.info().frame, std::move(undulations), *std::move(heights), *std::move(metrics),
                   metric, *sea);
}

Terrain::Terrain(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights,
                 MetricRasters metrics, ErrorMetric metric, const Raster<std::uint8_t>& sea)
    : parts_(std::make_unique<Parts>(
          std::make_shared<MemoryPyramid>(frame, std::move(heights), std::move(metrics), sea),
          std::move(undulations))) {
    TileStoreOptions at_once;
    at_once.memory_bytes = std::numeric_limits<std::size_t>::max() / 2;
    at_once.threads = 0;
    at_once.fade_s = 0;
    auto tiles = TileStore::open(*parts_->pyramid, parts_->positions, parts_->undulations, metric, at_once);
    assert(tiles);  // reading memory does not fail
    parts_->tiles = std::move(*tiles);
}

}  // namespace relevo::lod
