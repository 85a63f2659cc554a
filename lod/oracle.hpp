#pragma once

#include <cstdint>
#include <optional>

#include "lod/mesh.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// The measured error of a drawn mesh on the screen, in pixels: over every full-resolution post in view and
/// every pixel that the mesh covers, the distance between where the true terrain point appears and where the
/// drawn surface's point with the same grid coordinates does.
struct MeasuredError {
    double max_px = 0;
    double rms_px = 0;
    double p99_px = 0;
    std::uint64_t posts = 0;   ///< posts compared
    std::uint64_t pixels = 0;  ///< pixels compared
    /// Valid posts in view under no triangle: a hole, always a fault.
    std::uint64_t uncovered_posts = 0;
};

/// Measures by brute force and by ways of its own: heights from the scene, positions by GeographicLib,
/// neither the metrics nor the spheres nor the tables that made the mesh. Nothing is returned where nothing
/// is in view.
std::optional<MeasuredError> measure_error(const Terrain& terrain, const View& view, const Mesh& mesh,
                                           double exaggeration = 1);

}  // namespace relevo::lod
