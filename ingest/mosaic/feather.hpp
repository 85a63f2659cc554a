#pragma once

#include "geo/frame.hpp"
#include "ingest/affine.hpp"
#include "ingest/resample/warp.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// How far a blend may reach, in posts of the scene.
inline constexpr int kMostFeatherPosts = 256;

/// Blends a finer layer into what lies under it.
///
/// At a post where both have a height its weight is d / width, at most 1, with d the distance in metres (with
/// the post spacing of its tile) to the nearest post where only the one under it has; both are looked at up
/// to kMostFeatherPosts away. Where nothing else has a height the finer layer stays as it is, up to its edge.
class Feather {
  public:
    Feather(const geo::GridFrame& frame, double width_m) : frame_(frame), width_m_(width_m) {}

    /// A window and the posts around it that its blend depends on.
    Window with_halo(Window window) const;

    /// The finer layer's weights in `window`, of which both are given in `halo`. \pre halo holds
    /// with_halo(window)
    lod::Raster<float> weights(const lod::Raster<float>& finer, const lod::Raster<float>& under, Window halo,
                               Window window) const;

  private:
    /// Posts that are nearer than the width along columns and rows, around a post.
    struct Reach {
        int columns = 0;
        int rows = 0;
        double column_m = 0;
        double row_m = 0;
    };
    Reach reach(int column, int row) const;

    geo::GridFrame frame_;
    double width_m_;
};

}  // namespace relevo::ingest
