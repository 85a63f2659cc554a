#pragma once

#include <functional>
#include <span>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "ingest/mosaic/layer_in_scene.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// Differences between the scene's surface and source posts, summed up.
struct ErrorSum {
    double squares = 0;
    double largest = 0;
    std::uint64_t posts = 0;
    std::uint64_t lost = 0;

    void add(const ErrorSum& other);
};

/// Heights of the finished scene in a window of its frame.
using SceneHeights = std::function<Result<lod::Raster<float>>(Window)>;

/// A window of a layer, whose posts are compared with the scene's surface (bilinear between its posts, as
/// measuring tools read it). Posts that a layer above has a height for are not: it is not them that the scene
/// was made of. \param above  the layers that count more \param part_wanted  the scene is a crop: posts
/// outside of it are not lost
Result<ErrorSum> layer_error(const LayerInScene& layer, std::span<const LayerInScene> above, Window window,
                             const geo::GridFrame& frame, bool part_wanted, const SceneHeights& scene);

/// The windows of a layer that layer_error is to be called for: of kTransformTile posts times 8, where
/// members are and the scene may be.
std::vector<Window> windows_to_compare(const LayerInScene& layer, const geo::GridFrame& frame,
                                       bool part_wanted);

}  // namespace relevo::ingest
