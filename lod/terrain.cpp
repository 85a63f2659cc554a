#include "lod/terrain.hpp"

#include <utility>

#include "lod/mesh_heights.hpp"
#include "lod/soar/stored_metrics.hpp"

namespace relevo::lod {

Result<Terrain> Terrain::load(const Scene& scene, ErrorMetric metric) {
    auto heights = scene.read_all_heights();
    if (!heights) return heights.error();
    const auto metrics = load_metrics(scene, *heights);
    if (!metrics) return metrics.error();
    return Terrain(scene.info().frame, scene.undulations(), *std::move(heights), *metrics, metric);
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
           undulations_.nodes().samples().size() * sizeof(float);
}

}  // namespace relevo::lod
