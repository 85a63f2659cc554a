#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geo/post_positions.hpp"
#include "geo/result.hpp"
#include "lod/error_metric.hpp"
#include "lod/level_bounds.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// A scene in memory, ready to be meshed: the padded 2^n + 1 grid with heights for every post (voids and
/// padding are filled for the mesh only) and the metrics of every vertex.
class Terrain {
  public:
    /// What refinement reads of a vertex, together in one place.
    struct Post {
        float H;               ///< metres above the vertical datum
        std::uint16_t error;   ///< code of the object-space error
        std::uint16_t radius;  ///< code of the sphere's radius; 0: nothing valid below
    };

    /// The incremental error serves in place of the bounded one where a scene was imported without that.
    static Result<Terrain> load(const Scene& scene, ErrorMetric metric);

    /// From parts in memory: heights of the data (void = NaN) and the chosen metric's errors and radii.
    /// \param sea  255 at posts of the class sea, else 0; empty: there is none
    Terrain(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights,
            const MetricRasters& metrics, ErrorMetric metric, Raster<std::uint8_t> sea = {});

    const geo::GridFrame& frame() const { return frame_; }
    int levels() const { return levels_; }  ///< n: the grid has 2^n + 1 posts a side
    const geo::PostPositions& positions() const { return positions_; }
    const UndulationGrid& undulations() const { return undulations_; }

    const Post& post(int column, int row) const {
        return posts_[(static_cast<std::size_t>(row) << levels_) + static_cast<std::size_t>(row) +
                      static_cast<std::size_t>(column)];
    }

    /// Heights H of the data as imported, void = NaN: what is true, unlike Post::H where there is nothing.
    const Raster<float>& heights() const { return heights_; }

    /// By vertex level: what an exaggeration adds to errors and radii.
    const std::vector<LevelBound>& level_bounds() const { return level_bounds_; }

    /// 255 at posts of the class sea, else 0; of no size where there is none.
    const Raster<std::uint8_t>& sea() const { return sea_; }

    std::uint64_t memory_bytes() const;

    /// Is there a valid height at this post of the padded grid?
    bool is_valid(int column, int row) const {
        return column < frame_.columns && row < frame_.rows && !std::isnan(heights_.at(column, row));
    }

    /// The true position of a post (filled in voids and padding), ECEF, metres, with heights H exaggerated.
    glm::dvec3 position(int column, int row, double exaggeration) const {
        const double H = static_cast<double>(post(column, row).H);
        return positions_.at(column, row, undulations_.at(column, row) + exaggeration * H);
    }

  private:
    geo::GridFrame frame_;
    int levels_;
    geo::PostPositions positions_;
    UndulationGrid undulations_;
    Raster<float> heights_;
    Raster<std::uint8_t> sea_;
    std::vector<Post> posts_;
    std::vector<LevelBound> level_bounds_;
};

}  // namespace relevo::lod
