#pragma once

#include <vector>

#include "lod/pyramid/ground_normals.hpp"
#include "lod/pyramid/pyramid.hpp"

namespace relevo::lod {

/// A pyramid of rasters in memory: every level is taken out of the whole grid.
class MemoryPyramid final : public Pyramid {
  public:
    /// \param heights  H of the data, void = NaN
    /// \param metrics  codes of the whole padded grid (build_metrics)
    /// \param sea      255 at posts of the data that are sea, else 0; empty: none is
    MemoryPyramid(const geo::GridFrame& frame, Raster<float> heights, MetricRasters metrics,
                  const Raster<std::uint8_t>& sea = {});

    const geo::GridFrame& frame() const override { return frame_; }
    Result<VertexPosts> read_vertices(const PyramidBlock& block, ErrorMetric metric) const override;
    Result<GroundPosts> read_ground(const PyramidBlock& block) const override;

  private:
    geo::GridFrame frame_;
    Raster<float> heights_;
    Raster<float> filled_;  // of the padded grid
    MetricRasters metrics_;
    std::vector<Ground> ground_;  // by level: of the posts of the data
};

}  // namespace relevo::lod
