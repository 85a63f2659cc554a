#include <cmath>

#include <fmt/format.h>

#include "app/measure/measure.hpp"
#include "lod/measure/results.hpp"

namespace relevo::app {
namespace {

void print_ground(const lod::PathMeasurement& path, const lod::SceneInfo& info, geo::UnitSystem units) {
    if (!path.surface_m) {
        fmt::print("ground     not measured: the line crosses a void or leaves the scene\n");
        return;
    }
    fmt::print("ground     {} over the surface, at its height\n", geo::length_text(*path.surface_m, units));
    fmt::print("climb      {}, descent {}, of heights above {}\n", geo::height_text(*path.climb_m, units),
               geo::height_text(*path.descent_m, units), datum_text(info.vertical));
}

}  // namespace

Result<nlohmann::json> measure_path(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                    const Places& places) {
    const auto path = lod::measure_path(sampler, places);
    if (!path) return path.error();
    const bool line = flags.what == "line";
    if (flags.common.json) return line ? lod::results_of(path->legs.front()) : lod::results_of(*path);

    const geo::UnitSystem units = flags.unit_system();
    fmt::print("geodesic   {} on the WGS 84 ellipsoid\n", geo::length_text(path->length_m, units));
    if (path->legs.size() == 1) {
        const geo::GeodesicLine& leg = path->legs.front().geodesic;
        fmt::print("azimuth    {:.6f} degrees at the start, {:.6f} at the end\n", leg.azimuth1.value,
                   leg.azimuth2.value);
    } else {
        for (std::size_t i = 0; i < path->legs.size(); ++i) {
            const geo::GeodesicLine& leg = path->legs[i].geodesic;
            fmt::print("leg {:<6} {}, azimuth {:.6f} to {:.6f}{}\n", i + 1,
                       geo::length_text(leg.length_m, units), leg.azimuth1.value, leg.azimuth2.value,
                       i < path->turns.size()
                           ? fmt::format("; then {:.6f} degrees to the {}", std::abs(path->turns[i].value),
                                         path->turns[i].value < 0 ? "left" : "right")
                           : "");
        }
    }
    print_ground(*path, sampler.scene().info(), units);
    return line ? lod::results_of(path->legs.front()) : lod::results_of(*path);
}

}  // namespace relevo::app
