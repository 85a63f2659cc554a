#pragma once

#include <cstdint>
#include <vector>

#include "geo/result.hpp"
#include "ingest/mosaic/grid_map.hpp"
#include "ingest/mosaic/layer.hpp"
#include "ingest/resample/interpolated_transform.hpp"
#include "ingest/resample/resample.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// A window of the scene as one layer has it: heights above the layer's datum, void = NaN, and the source of
/// each valid post.
struct LayerPosts {
    lod::Raster<float> heights;
    lod::Raster<std::uint16_t> sources;

    LayerPosts(int columns, int rows);
};

/// Source posts held at once while a part of a block is made: 2^21 of 18 bytes, and what reading them takes.
inline constexpr std::int64_t kMostSourcePosts = std::int64_t{1} << 21;

/// Resamples a layer to posts of the scene.
///
/// Work goes in tiles of kTransformTile posts: positions by TileMesh, and as many tiles at a time as need at
/// most kMostSourcePosts of the layer (a single post may need more, where it is the mean of a large area). A
/// post's height depends on its tile alone.
class Warp {
  public:
    /// Any thread may use it. \pre the layer outlives this
    Warp(const Layer& layer, const GridMap& map, Resampling method)
        : layer_(&layer), map_(map), method_(method) {}

    /// The posts of a window; those of tiles that are not wanted stay void. \param wanted  of each tile, row
    /// by row \pre the window starts at multiples of kTransformTile, and ends at such or at the grid's edge
    Result<LayerPosts> read(Window window, const std::vector<bool>& wanted) const;

    Resampling method() const { return method_; }

  private:
    const Layer* layer_;
    GridMap map_;
    Resampling method_;
};

}  // namespace relevo::ingest
