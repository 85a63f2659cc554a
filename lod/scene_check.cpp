#include "lod/scene_check.hpp"

#include <algorithm>
#include <cmath>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/soar/refiner.hpp"

namespace relevo::lod {

std::uint64_t count_nesting_faults(const geo::GridFrame& frame, const MetricRasters& metrics) {
    const int levels = frame.levels();
    const auto is_nested = [&](const GridPoint& v, const GridPoint& child) {
        const auto at = [](const Raster<std::uint16_t>& raster, const GridPoint& p) {
            return raster.at(p.column, p.row);
        };
        // A sphere reaches round its child's; the codes alone show that it is at least as large.
        return at(metrics.bounded, v) >= at(metrics.bounded, child) &&
               at(metrics.incremental, v) >= at(metrics.incremental, child) &&
               at(metrics.radius, v) >= at(metrics.radius, child);
    };
    std::uint64_t faults = 0;
    for (int level = 0; level < 2 * levels; ++level) {
        for (int row = 0; row < frame.padded_side(); ++row) {
            for_each_vertex_in_row(levels, level, row, [&](const GridPoint& v) {
                for (const GridPoint& child : children(v, level, levels)) {
                    if (!is_nested(v, child)) {
                        ++faults;
                        return;
                    }
                }
            });
        }
    }
    return faults;
}

Result<ViewsCheck> check_views(const Terrain& terrain, ErrorMetric metric, std::span<const Camera> cameras,
                               double tau_px, bool morph) {
    ViewsCheck result;
    result.metric = metric;
    result.morph = morph;
    result.tau_px = tau_px;
    Refiner refiner(terrain);
    double sum2 = 0;
    for (const Camera& camera : cameras) {
        const View view(camera);
        const auto whole = refiner.refine_whole(view, {.tau_px = tau_px, .morph = morph});
        if (!whole) return whole.error();
        const Mesh& mesh = **whole;
        ++result.views;
        result.triangles_mean += static_cast<double>(mesh.triangles()) / static_cast<double>(cameras.size());
        result.t_vertices += count_t_vertices(mesh);
        result.torn_posts += count_torn_posts(mesh);
        const auto error = measure_error(terrain, view, mesh);
        if (!error) continue;
        ++result.views_with_ground;
        result.max_px = std::max(result.max_px, error->max_px);
        sum2 += error->rms_px * error->rms_px;
        result.uncovered_posts += error->uncovered_posts;
    }
    if (result.views_with_ground > 0) result.rms_px = std::sqrt(sum2 / result.views_with_ground);
    return result;
}

}  // namespace relevo::lod
