#include "lod/terrain.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "lod/pyramid/memory_pyramid.hpp"
#include "lod/pyramid/scene_pyramid.hpp"

namespace relevo::lod {

Terrain::Parts::Parts(std::shared_ptr<const Pyramid> of, UndulationGrid N, std::size_t posts_bytes)
    : pyramid(std::move(of)),
      positions(pyramid->frame()),
      undulations(std::move(N)),
      bounds(lod::level_bounds(pyramid->frame(), undulations)),
      posts(*pyramid, posts_bytes) {}

Result<Terrain> Terrain::open(std::shared_ptr<const Pyramid> pyramid, UndulationGrid undulations,
                              ErrorMetric metric, const TileStoreOptions& options) {
    auto parts = std::make_unique<Parts>(std::move(pyramid), std::move(undulations),
                                         std::min(options.memory_bytes / 4, TruePosts::kMemoryBytes));
    auto tiles = TileStore::open(*parts->pyramid, parts->positions, parts->undulations, metric, options);
    if (!tiles) return tiles.error();
    parts->tiles = std::move(*tiles);
    return Terrain(std::move(parts));
}

Result<Terrain> Terrain::open(const Scene& scene, ErrorMetric metric, const TileStoreOptions& options) {
    auto pyramid = ScenePyramid::open(scene, std::max(options.memory_bytes / 4, std::size_t{8} << 20));
    if (!pyramid) return pyramid.error();
    return open(std::make_shared<ScenePyramid>(std::move(*pyramid)), scene.undulations(), metric, options);
}

Terrain::Terrain(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights,
                 MetricRasters metrics, ErrorMetric metric, const Raster<std::uint8_t>& sea)
    : parts_(std::make_unique<Parts>(
          std::make_shared<MemoryPyramid>(frame, std::move(heights), std::move(metrics), sea),
          std::move(undulations), TruePosts::kMemoryBytes)) {
    TileStoreOptions at_once;
    at_once.memory_bytes = std::numeric_limits<std::size_t>::max() / 2;
    at_once.threads = 0;
    at_once.fade_s = 0;
    auto tiles = TileStore::open(*parts_->pyramid, parts_->positions, parts_->undulations, metric, at_once);
    assert(tiles);  // reading memory does not fail
    parts_->tiles = std::move(*tiles);
}

}  // namespace relevo::lod
