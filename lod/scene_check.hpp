#pragma once

#include <cstdint>
#include <span>

#include "geo/result.hpp"
#include "lod/sample_views.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// Vertices whose error or sphere is smaller than a child's needs: each could open a crack.
std::uint64_t count_nesting_faults(const geo::GridFrame& frame, const MetricRasters& metrics);

/// What a set of views measured at one tau.
struct ViewsCheck {
    ErrorMetric metric = ErrorMetric::bounded;
    bool morph = false;
    double tau_px = 0;
    int views = 0;
    int views_with_ground = 0;  ///< that had something to measure
    double triangles_mean = 0;
    double max_px = 0;
    double rms_px = 0;  ///< of the views' RMS errors
    std::uint64_t uncovered_posts = 0;
    int t_vertices = 0;
    int torn_posts = 0;
};

/// Refines the terrain for each camera and measures the result with the oracle.
Result<ViewsCheck> check_views(const Terrain& terrain, ErrorMetric metric, std::span<const Camera> cameras,
                               double tau_px, bool morph);

}  // namespace relevo::lod
