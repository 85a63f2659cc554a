#include "lod/terrain.hpp"

#include <utility>

#include "lod/mesh_heights.hpp"
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

Result<Terrain> Terrain::load(const Scene& scene, ErrorMetric metric) {
    auto heights = scene.read_all_heights();
    if (!heights) return heights.error();
    UndulationGrid undulations = scene.undulations();
    const auto metrics = load_metrics(scene, *heights, undulations);
    if (!metrics) return metrics.error();
    auto sea = read_sea(scene, *heights);
    if (!sea) return sea.error();
    return Terrain(scene.info().frame, std::move(undulations), *std::move(heights), *metrics, metric,
                   *std::move(sea));
}

Terrain::Terrain(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights,
                 const MetricRasters& metrics, ErrorMetric metric, Raster<std::uint8_t> sea)
    : frame_(frame),
      levels_(frame.levels()),
      positions_(frame),
      undulations_(std::move(undulations)),
      heights_(std::move(heights)),
      sea_(std::move(sea)),
      level_bounds_(lod::level_bounds(frame_, undulations_)) {
    const Raster<float> filled = mesh_heights(frame_, heights_);
    const Raster<std::uint16_t>& errors =
        metric == ErrorMetric::bounded ? metrics.bounded : metrics.incremental;
    posts_.resize(filled.samples().size());
    for (std::size_t i = 0; i < posts_.size(); ++i) {
        posts_[i] = {filled.samples()[i], errors.samples()[i], metrics.radius.samples()[i]};
    }
}

std::uint64_t Terrain::memory_bytes() const {
    return posts_.size() * sizeof(Post) + heights_.samples().size() * sizeof(float) + sea_.samples().size() +
           undulations_.memory_bytes();
}

}  // namespace relevo::lod
