#include "lod/measure/path.hpp"

#include <cassert>

namespace relevo::lod {

Result<PathMeasurement> measure_path(HeightSampler& sampler, std::span<const geo::LatLon> path) {
    assert(path.size() >= 2);
    PathMeasurement whole;
    whole.surface_m = whole.climb_m = whole.descent_m = 0;
    const auto add = [](std::optional<double>& sum, const std::optional<double>& part) {
        sum = sum && part ? std::optional(*sum + *part) : std::nullopt;
    };
    for (std::size_t i = 1; i < path.size(); ++i) {
        const auto leg = measure_line(sampler, path[i - 1], path[i]);
        if (!leg) return leg.error();
        if (!whole.legs.empty())
            whole.turns.push_back(
                geo::wrapped_180(leg->geodesic.azimuth1 - whole.legs.back().geodesic.azimuth2));
        whole.length_m += leg->geodesic.length_m;
        add(whole.surface_m, leg->surface_m);
        add(whole.climb_m, leg->climb_m);
        add(whole.descent_m, leg->descent_m);
        whole.legs.push_back(*leg);
    }
    return whole;
}

}  // namespace relevo::lod
