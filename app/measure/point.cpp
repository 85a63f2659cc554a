#include <fmt/format.h>

#include "app/measure/measure.hpp"
#include "geo/coordinate_text.hpp"
#include "lod/measure/results.hpp"

namespace relevo::app {
namespace {

void print_heights(const lod::PointMeasurement& m, const lod::VerticalReference& vertical,
                   geo::UnitSystem units) {
    switch (m.kind) {
        case lod::PointClass::outside:
            fmt::print("height     none: outside the scene\n");
            return;
        case lod::PointClass::none:
            fmt::print("height     none: the data has a void here\n");
            return;
        case lod::PointClass::land:
        case lod::PointClass::sea:
            break;
    }
    fmt::print("class      {}\n", lod::to_string(m.kind));
    if (m.filled) fmt::print("filled     the data has a void here: its height is interpolated over it\n");
    if (m.modelled) fmt::print("modelled   nobody measured this sea bed: its height is made up\n");
    fmt::print("H          {} above {}\n", geo::height_text(m.H->m, units), datum_text(vertical));
    if (m.h) {
        fmt::print("h          {} above the WGS 84 ellipsoid\n", geo::height_text(m.h->m, units));
    } else {
        fmt::print("h          unknown: the geoid of {} is not here\n", vertical.name);
    }
    if (m.N && vertical.datum == lod::VerticalDatum::egm96)
        fmt::print("N          {}, EGM96 above the WGS 84 ellipsoid\n", geo::height_text(m.N->m, units));
    if (m.slope) {
        fmt::print(
            "slope      {:.2f} degrees{}\n", m.slope->degrees,
            m.slope->aspect ? fmt::format(", falling to azimuth {:.1f}", m.slope->aspect->value) : ": level");
    }
}

void print_data(const lod::PointMeasurement& m, const lod::PointSource& source, const lod::SceneInfo& info,
                geo::UnitSystem units) {
    if (m.kind == lod::PointClass::outside) return;
    fmt::print("data       a post every {}; resampling error {:.3g} m RMS\n",
               geo::height_text(m.resolution_m, units, 2), info.resampling.rms_m);
    if (m.nearest_post) {
        const auto& post = *m.nearest_post;
        fmt::print("post       {} at {}, {} away\n",
                   post.H_m ? geo::height_text(*post.H_m, units) : std::string("a void"),
                   place_text(post.place), geo::length_text(post.distance_m, units));
    }
    const bool known = source.info != nullptr && source.info->operation_accuracy_m;
    fmt::print("accuracy   of heights: unknown, the source does not state it; of the place: {}\n",
               known ? fmt::format("{:.3g} m from the source's CRS to WGS 84, as stated by PROJ",
                                   *source.info->operation_accuracy_m)
                     : "unknown");
}

}  // namespace

Result<nlohmann::json> measure_point(const MeasureFlags& flags, lod::HeightSampler& sampler,
                                     geo::LatLon place) {
    const lod::SceneInfo& info = sampler.scene().info();
    const auto m = lod::measure_point(sampler, place);
    if (!m) return m.error();
    const lod::PointSource source = lod::source_of(info, *m);
    if (!flags.common.json) {
        fmt::print("WGS 84     {}   {}\n", geo::to_decimal_degrees(place), geo::to_dms(place));
        fmt::print("UTM        {}   MGRS {}\n", geo::to_utm(place), geo::to_mgrs(place));
        if (source.position) {
            const int decimals = source.info->step_unit == "degree" ? 8 : 3;
            fmt::print("{:<10} x {:.{}f}, y {:.{}f}\n", source.info->crs, source.position->x, decimals,
                       source.position->y, decimals);
        }
        print_heights(*m, info.vertical, flags.unit_system());
        print_data(*m, source, info, flags.unit_system());
    }
    return lod::results_of(*m, source, info);
}

}  // namespace relevo::app
