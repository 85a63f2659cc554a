#include <fmt/format.h>

#include "app/measure/measure.hpp"
#include "lod/measure/plane.hpp"
#include "lod/measure/results.hpp"

namespace relevo::app {
namespace {

void print_text(const lod::AreaMeasurement& area, const lod::SceneInfo& info, geo::UnitSystem units) {
    fmt::print("area       {} on the WGS 84 ellipsoid\n", geo::area_text(area.geodesic.area_m2, units));
    fmt::print("perimeter  {}\n", geo::length_text(area.geodesic.perimeter_m, units));
    const auto share = [&](const char* what, double m2) {
        if (m2 > 0)
            fmt::print("no height  {} ({:.3g} %) {}: not in what follows\n", geo::area_text(m2, units),
                       100 * m2 / area.geodesic.area_m2, what);
    };
    share("is a void of the data", area.void_m2);
    share("is outside the scene", area.outside_m2);
    if (!area.surface_m2) {
        fmt::print("ground     not measured: the scene has no height here\n");
        return;
    }
    fmt::print("surface    {} of the ground, at its height\n", geo::area_text(*area.surface_m2, units));
    fmt::print("lowest     {} at {}\n", geo::height_text(area.lowest->value, units),
               place_text(area.lowest->place));
    fmt::print("highest    {} at {}\n", geo::height_text(area.highest->value, units),
               place_text(area.highest->place));
    fmt::print("mean H     {}; heights are above {}\n", geo::height_text(*area.mean_H_m, units),
               datum_text(info.vertical));
    fmt::print("slope      {:.3f} degrees in the mean", *area.mean_slope_deg);
    if (area.steepest_deg)
        fmt::print(", {:.3f} at most, at {}", area.steepest_deg->value, place_text(area.steepest_deg->place));
    fmt::print("\nvolume     {} above H = {}, {} below it\n", geo::volume_text(*area.volume_above_m3, units),
               geo::height_text(*area.plane_H_m, units), geo::volume_text(*area.volume_below_m3, units));
}

}  // namespace

Result<nlohmann::json> measure_area(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                    const Places& polygon) {
    const auto plane = lod::parse_plane(flags.plane);
    if (!plane) return plane.error();
    const auto area =
        lod::measure_area(sampler, polygon, *plane, [bar = progress_bar(flags.common, "area")](double done) {
            bar(done);
            return true;
        });
    if (!area) return area.error();
    if (!flags.common.json) print_text(*area, sampler.scene().info(), flags.unit_system());
    return lod::results_of(*area, sampler.scene().info());
}

}  // namespace relevo::app
