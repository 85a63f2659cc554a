#include "output/viewshed_file.hpp"
#include <fmt/format.h>

#include "app/measure/measure.hpp"
#include "lod/measure/results.hpp"

namespace relevo::app {
namespace {

void print_text(const lod::SightMeasurement& sight, const lod::Looking& looking, const lod::SceneInfo& info,
                geo::UnitSystem units) {
    const auto place = [&](const lod::SightMeasurement::Place& p) {
        return fmt::format("after {}, at {}, ground {}", geo::length_text(p.distance_m, units),
                           place_text(p.place), geo::height_text(p.H_m, units));
    };
    if (!sight.visible) {
        fmt::print("visible    unknown: {} of the line {} over no known ground\n",
                   geo::length_text(sight.unknown_m, units),
                   sight.eye_H_m && sight.target_H_m ? "is" : "and an end of it are");
    } else {
        fmt::print("visible    {}\n", *sight.visible ? "yes" : "no");
    }
    fmt::print("distance   {}, azimuth {:.6f} degrees\n", geo::length_text(sight.geodesic.length_m, units),
               sight.geodesic.azimuth1.value);
    if (sight.eye_H_m && sight.target_H_m)
        fmt::print("heights    eye {}, target {} above {}\n", geo::height_text(*sight.eye_H_m, units),
                   geo::height_text(*sight.target_H_m, units), datum_text(info.vertical));
    if (sight.first_blocked) fmt::print("blocked    first {}\n", place(*sight.first_blocked));
    if (sight.worst)
        fmt::print("worst      {} under the ground, {}\n", geo::height_text(-sight.worst->clearance_m, units),
                   place(*sight.worst));
    if (sight.least_clearance)
        fmt::print("clearance  {} at least, {}\n",
                   geo::height_text(sight.least_clearance->clearance_m, units),
                   place(*sight.least_clearance));
    fmt::print("air        refraction coefficient {:g}\n", looking.refraction);
}

}  // namespace

Result<nlohmann::json> measure_sight(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                     const Places& ends) {
    const auto sight = lod::measure_sight(sampler, ends[0], ends[1], flags.looking);
    if (!sight) return sight.error();
    if (!flags.common.json) print_text(*sight, flags.looking, sampler.scene().info(), flags.unit_system());
    return lod::results_of(*sight, flags.looking);
}

Result<nlohmann::json> measure_viewshed(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                        geo::LatLon eye) {
    const lod::ViewshedRequest request{flags.looking, flags.radius_m,
                                       [bar = progress_bar(flags.common, "viewshed")](double done) {
                                           bar(done);
                                           return true;
                                       }};
    const auto shed = lod::measure_viewshed(sampler, eye, request);
    if (!shed) return shed.error();
    if (!flags.output.empty()) {
        const auto written =
            output::write_viewshed(flags.output, sampler.scene().info(), *shed, flags.overwrite);
        if (!written) return written.error();
    }
    auto json = lod::results_of(*shed, request);
    json["file"] = flags.output.empty() ? nlohmann::json() : nlohmann::json(flags.output);
    if (flags.common.json) return json;
    const geo::UnitSystem units = flags.unit_system();
    fmt::print("eye        {} above {}\n", geo::height_text(shed->eye_H_m, units),
               datum_text(sampler.scene().info().vertical));
    fmt::print("visible    {}, {} posts\n", geo::area_text(shed->visible_m2, units), shed->visible_posts);
    fmt::print("hidden     {}, {} posts\n", geo::area_text(shed->hidden_m2, units), shed->hidden_posts);
    if (shed->unknown_posts > 0)
        fmt::print("unknown    {}, {} posts: their lines of sight are over voids or outside\n",
                   geo::area_text(shed->unknown_m2, units), shed->unknown_posts);
    fmt::print("air        refraction coefficient {:g}\n", flags.looking.refraction);
    if (!flags.output.empty()) fmt::print("file       {}\n", flags.output);
    return json;
}

}  // namespace relevo::app
