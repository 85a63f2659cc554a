#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "geo/coordinate_text.hpp"
#include "lod/measure/height_sampler.hpp"
#include "lod/measure/line.hpp"
#include "lod/measure/point.hpp"
#include "lod/measure/source_position.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::app {
namespace {

struct Settings {
    Common common;
    std::string scene;
    std::string what;
    std::vector<std::string> places;
};

template <class Height>
nlohmann::json metres(const std::optional<Height>& height) {
    return height ? nlohmann::json(height->m) : nlohmann::json();
}

nlohmann::json or_null(const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json();
}

std::string class_name(lod::PointClass kind) {
    switch (kind) {
        case lod::PointClass::land:
            return "land";
        case lod::PointClass::sea:
            return "sea";
        case lod::PointClass::none:
            return "void";
        case lod::PointClass::outside:
            break;
    }
    return "outside";
}

/// The datum of the heights H, and whether the source said so.
std::string datum_text(const lod::VerticalReference& vertical) {
    return vertical.name + (vertical.assumed ? " (assumed: the source does not say)" : "");
}

// --- point

struct Point {
    lod::PointMeasurement measured;
    const lod::SourceInfo* source_info;  // of the nearest post; of the first source where there is none
    std::optional<lod::SourcePosition> source;
};

void print_json(const Point& point, const lod::SceneInfo& info) {
    const auto& [m, source_info, source] = point;
    const bool inside = m.kind != lod::PointClass::outside;
    nlohmann::json source_crs;
    if (source_info != nullptr) {
        source_crs = {{"code", source_info->crs},
                      {"x", source ? nlohmann::json(source->x) : nlohmann::json()},
                      {"y", source ? nlohmann::json(source->y) : nlohmann::json()}};
    }
    const nlohmann::json json = {{"lat", m.place.lat.value},
                                 {"lon", m.place.lon.value},
                                 {"class", class_name(m.kind)},
                                 {"H_m", metres(m.H)},
                                 {"h_m", metres(m.h)},
                                 {"N_m", metres(m.N)},
                                 {"vertical_datum", info.vertical.name},
                                 {"source_crs", source_crs},
                                 {"utm", geo::to_utm(m.place)},
                                 {"mgrs", geo::to_mgrs(m.place)},
                                 {"resolution_m", inside ? nlohmann::json(m.resolution_m) : nlohmann::json()},
                                 {"resampling_rms_m", info.resampling.rms_m},
                                 {"filled", m.filled},
                                 {"modelled", m.modelled}};
    fmt::print("{}\n", json.dump());
}

void print_heights(const lod::PointMeasurement& m, const lod::VerticalReference& vertical) {
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
    if (m.kind == lod::PointClass::sea) fmt::print("class      sea\n");
    if (m.filled) fmt::print("filled     the data has a void here: its height is interpolated over it\n");
    if (m.modelled) fmt::print("modelled   nobody measured this sea bed: its height is made up\n");
    fmt::print("H          {:.3f} m above {}\n", m.H->m, datum_text(vertical));
    if (m.h) {
        fmt::print("h          {:.3f} m above the WGS 84 ellipsoid\n", m.h->m);
    } else {
        fmt::print("h          unknown: the geoid of {} is not here\n", vertical.name);
    }
    if (m.N && vertical.datum == lod::VerticalDatum::egm96)
        fmt::print("N          {:.3f} m, EGM96 above the WGS 84 ellipsoid\n", m.N->m);
}

void print_text(const Point& point, const lod::SceneInfo& info) {
    const auto& [m, source_info, source] = point;
    fmt::print("WGS 84     {}   {}\n", geo::to_decimal_degrees(m.place), geo::to_dms(m.place));
    fmt::print("UTM        {}   MGRS {}\n", geo::to_utm(m.place), geo::to_mgrs(m.place));
    if (source) {
        const int decimals = source_info->step_unit == "degree" ? 8 : 3;
        fmt::print("{:<10} x {:.{}f}, y {:.{}f}\n", source_info->crs, source->x, decimals, source->y,
                   decimals);
    }
    print_heights(m, info.vertical);
    if (m.kind != lod::PointClass::outside)
        fmt::print("data       a post every {:.2f} m; resampling error {:.3g} m RMS\n", m.resolution_m,
                   info.resampling.rms_m);
}

Result<void> measure_point(const Settings& settings, lod::HeightSampler& sampler, geo::LatLon place) {
    const lod::SceneInfo& info = sampler.scene().info();
    const auto measured = lod::measure_point(sampler, place);
    if (!measured) return measured.error();
    Point point{*measured, nullptr, {}};
    if (!info.sources.empty()) {
        point.source_info = &info.sources[static_cast<std::size_t>(measured->source.value_or(0))];
        point.source = lod::source_position(*point.source_info, place);
    }
    settings.common.json ? print_json(point, info) : print_text(point, info);
    return {};
}

// --- line

void print_json(const lod::LineMeasurement& line) {
    const nlohmann::json json = {{"geodesic_m", line.geodesic.length_m},
                                 {"azimuth1_deg", line.geodesic.azimuth1.value},
                                 {"azimuth2_deg", line.geodesic.azimuth2.value},
                                 {"surface_m", or_null(line.surface_m)},
                                 {"climb_m", or_null(line.climb_m)},
                                 {"descent_m", or_null(line.descent_m)}};
    fmt::print("{}\n", json.dump());
}

void print_text(const lod::LineMeasurement& line, const lod::SceneInfo& info) {
    fmt::print("geodesic   {:.3f} m on the WGS 84 ellipsoid\n", line.geodesic.length_m);
    fmt::print("azimuth    {:.6f} degrees at the start, {:.6f} at the end\n", line.geodesic.azimuth1.value,
               line.geodesic.azimuth2.value);
    if (!line.surface_m) {
        fmt::print("ground     not measured: the line crosses a void or leaves the scene\n");
        return;
    }
    fmt::print("ground     {:.3f} m over the surface, at its height\n", *line.surface_m);
    fmt::print("climb      {:.3f} m, descent {:.3f} m, of heights above {}\n", *line.climb_m, *line.descent_m,
               datum_text(info.vertical));
}

Result<void> measure_line(const Settings& settings, lod::HeightSampler& sampler, geo::LatLon from,
                          geo::LatLon to) {
    const auto line = lod::measure_line(sampler, from, to);
    if (!line) return line.error();
    settings.common.json ? print_json(*line) : print_text(*line, sampler.scene().info());
    return {};
}

Result<void> run(const Settings& settings) {
    const std::size_t needed = settings.what == "point" ? 1 : 2;
    if (settings.places.size() != needed)
        return Error{
            ErrorKind::usage,
            fmt::format("measure {} needs {}, not {}. A place with spaces in it goes between quotes: "
                        "\"37.58N 105.49W\".",
                        settings.what, needed == 1 ? "one place" : "two places", settings.places.size())};
    std::vector<geo::LatLon> places;
    for (const std::string& text : settings.places) {
        const auto place = geo::parse_lat_lon(text);
        if (!place) return place.error();
        places.push_back(*place);
    }
    const auto scene = lod::Scene::open(settings.scene);
    if (!scene) return scene.error();
    lod::HeightSampler sampler(*scene);
    return needed == 1 ? measure_point(settings, sampler, places[0])
                       : measure_line(settings, sampler, places[0], places[1]);
}

}  // namespace

void add_measure(CLI::App& program, Action& action) {
    auto settings = std::make_shared<Settings>();
    CLI::App* command =
        program.add_subcommand("measure", "Coordinates and heights of a place; lengths of a line");
    command->add_option("SCENE", settings->scene, "The scene")->required();
    command->add_option("WHAT", settings->what, "point or line")
        ->required()
        ->check(CLI::IsMember({"point", "line"}));
    command
        ->add_option(
            "PLACE", settings->places,
            "LAT,LON in decimal degrees, or degrees, minutes and seconds, UTM/UPS or MGRS; two for a line")
        ->required();
    add_common(*command, settings->common);
    command->footer(
        "Examples:\n"
        "  relevo measure dunes.relevo point 37.7397,-105.5146\n"
        "  relevo measure dunes.relevo point \"13S DB 54655 76935\" --json\n"
        "  relevo measure dunes.relevo line 37.7397,-105.5146 37.5775,-105.4856\n\n"
        "Heights come from the full data, bilinear between posts; lengths are geodesics on WGS 84.");
    command->callback([settings, &action] { action = [settings] { return run(*settings); }; });
}

}  // namespace relevo::app
