#include <cmath>

#include <fmt/format.h>

#include "app/measure/measure.hpp"
#include "lod/measure/results.hpp"

namespace relevo::app {
namespace {

void print_csv(const lod::Profile& profile) {
    fmt::print("distance_m,lat,lon,H_m,h_m\n");
    const auto or_nothing = [](const std::optional<double>& v) { return v ? fmt::format("{}", *v) : ""; };
    for (const lod::ProfileSample& s : profile.samples)
        fmt::print("{},{},{},{},{}\n", s.distance_m, s.place.lat.value, geo::wrapped_180(s.place.lon).value,
                   or_nothing(s.H_m), or_nothing(s.h_m));
}

void print_text(const lod::Profile& profile, const lod::SceneInfo& info, geo::UnitSystem units) {
    fmt::print("profile    {}, {} samples: at every crossing of a row or column of posts, and every peak\n",
               geo::length_text(profile.vertices_m.back(), units), profile.samples.size());
    const auto height = [&](const char* what, const std::optional<lod::Profile::Extreme>& e) {
        if (e)
            fmt::print("{:<10} {} after {}, at {}\n", what, geo::height_text(e->value, units),
                       geo::length_text(e->distance_m, units), place_text(e->place));
    };
    height("lowest", profile.lowest);
    height("highest", profile.highest);
    if (profile.mean_H_m)
        fmt::print("mean H     {}; heights are above {}\n", geo::height_text(*profile.mean_H_m, units),
                   datum_text(info.vertical));
    const auto slope = [&](const char* what, const std::optional<lod::Profile::Extreme>& e) {
        if (e)
            fmt::print("{:<10} {:.2f} % ({:.2f} degrees) after {}\n", what, 100 * std::abs(e->value),
                       geo::Degrees::from_radians(std::atan(std::abs(e->value))).value,
                       geo::length_text(e->distance_m, units));
    };
    slope("up", profile.steepest_up);
    slope("down", profile.steepest_down);
    if (profile.mean_slope) fmt::print("mean slope {:.2f} %, up or down\n", 100 * *profile.mean_slope);
    for (const lod::ProfileGap& gap : profile.gaps)
        fmt::print("no height  from {} to {}: {}\n", geo::length_text(gap.from_m, units),
                   geo::length_text(gap.to_m, units),
                   gap.outside ? "outside the scene" : "a void of the data");
}

}  // namespace

Result<nlohmann::json> measure_profile(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                       const Places& path) {
    const auto profile = lod::measure_profile(sampler, path);
    if (!profile) return profile.error();
    if (!flags.common.json) {
        if (flags.format == "csv") {
            print_csv(*profile);
        } else {
            print_text(*profile, sampler.scene().info(), flags.unit_system());
        }
    }
    return lod::results_of(*profile);
}

}  // namespace relevo::app
