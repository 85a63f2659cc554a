#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geo/post_positions.hpp"
#include "geo/result.hpp"
#include "lod/error_metric.hpp"
#include "lod/level_bounds.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene.hpp"
#include "lod/tiles/tile_store.hpp"
#include "lod/tiles/true_posts.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

class ChunkSet;

/// A terrain, ready to be meshed: where its posts lie, and those parts of its pyramid that are in memory. Its
/// size does not matter.
class Terrain {
  public:
    /// Reads the coarsest block.
    static Result<Terrain> open(std::shared_ptr<const Pyramid> pyramid, UndulationGrid undulations,
                                ErrorMetric metric, const TileStoreOptions& options);

    /// Of a scene. The incremental error serves in place of the bounded one where a scene was imported
    /// without that.
    static Result<Terrain> open(const Scene& scene, ErrorMetric metric, const TileStoreOptions& options);

    /// From rasters in memory: heights of the data (void = NaN) and the metrics of the padded grid. Tiles
    /// come at once when they are waited for. \param sea  255 at posts of the class sea, else 0; empty: there
    /// is none
    Terrain(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights,
            MetricRasters metrics, ErrorMetric metric, const Raster<std::uint8_t>& sea = {});

    const geo::GridFrame& frame() const { return parts_->pyramid->frame(); }
    int levels() const { return frame().levels(); }  ///< n: the padded grid has 2^n + 1 posts a side
    const geo::PostPositions& positions() const { return parts_->positions; }
    const UndulationGrid& undulations() const { return parts_->undulations; }
    const std::shared_ptr<const Pyramid>& pyramid() const { return parts_->pyramid; }

    /// By vertex level: what an exaggeration adds to errors and radii.
    const std::vector<LevelBound>& level_bounds() const { return parts_->bounds; }

    /// What meshes are made of.
    TileStore& tiles() const { return *parts_->tiles; }

    /// What the LSTR draws; null where nothing was given (lstr/chunk_file.hpp).
    const ChunkSet* chunks() const { return parts_->chunks.get(); }
    void use_chunks(std::shared_ptr<const ChunkSet> chunks) { parts_->chunks = std::move(chunks); }

    /// What is true.
    const TruePosts& posts() const { return parts_->posts; }

    /// Where a post with a height H is, ECEF, metres.
    glm::dvec3 position(int column, int row, double H, double exaggeration) const {
        return positions().at(column, row, undulations().at(column, row) + exaggeration * H);
    }

    /// Where a valid post is. For some posts: many ask a TruePosts::Reader for their heights.
    glm::dvec3 position(int column, int row, double exaggeration) const {
        const float H = TruePosts::Reader(posts()).H(column, row);
        return position(column, row, static_cast<double>(H), exaggeration);
    }

  private:
    struct Parts {
        Parts(std::shared_ptr<const Pyramid> of, UndulationGrid N, std::size_t posts_bytes);

        std::shared_ptr<const Pyramid> pyramid;
        geo::PostPositions positions;
        UndulationGrid undulations;
        std::vector<LevelBound> bounds;
        TruePosts posts;
        std::unique_ptr<TileStore> tiles;
        std::shared_ptr<const ChunkSet> chunks;
    };
    explicit Terrain(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

    std::unique_ptr<Parts> parts_;  // tiles keep pointers to the others
};

}  // namespace relevo::lod
