#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/measurement_file.hpp"
#include <fmt/format.h>

#include "app/measure/measure.hpp"
#include "geo/coordinate_text.hpp"
#include "lod/measure/plane.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::app {

std::string datum_text(const lod::VerticalReference& vertical) {
    return vertical.name + (vertical.assumed ? " (assumed: the source does not say)" : "");
}

std::string place_text(geo::LatLon place) {
    return geo::to_decimal_degrees(place);
}

namespace {

using Json = nlohmann::json;
using lod::Measurement;
using lod::MeasurementKind;

/// What can be asked for, and the places that it takes.
struct What {
    const char* name;
    MeasurementKind kind;
    std::size_t least;
    std::size_t most;
    const char* needs;
};
constexpr std::size_t kAny = 1'000'000;
constexpr What kWhat[] = {{"point", MeasurementKind::point, 1, 1, "one place"},
                          {"line", MeasurementKind::path, 2, 2, "two places"},
                          {"path", MeasurementKind::path, 2, kAny, "two places or more"},
                          {"profile", MeasurementKind::path, 2, kAny, "two places or more"},
                          {"area", MeasurementKind::polygon, 3, kAny, "three places or more"},
                          {"sight", MeasurementKind::path, 2, 2, "two places"},
                          {"viewshed", MeasurementKind::point, 1, 1, "one place"}};

const What& what_of(const MeasureFlags& flags) {
    return *std::find_if(std::begin(kWhat), std::end(kWhat),
                         [&](const What& what) { return flags.what == what.name; });
}

Error wrong_number(const What& what, std::size_t places) {
    return {ErrorKind::usage,
            fmt::format("measure {} needs {}, not {}. A place with spaces in it goes between "
                        "quotes: \"37.58N 105.49W\".",
                        what.name, what.needs, places)};
}

/// The places of the command line as one measurement, or those of a file that can be measured so.
Result<std::vector<Measurement>> wanted(const MeasureFlags& flags) {
    const What& what = what_of(flags);
    if (flags.from.empty()) {
        if (flags.places.size() < what.least || flags.places.size() > what.most)
            return wrong_number(what, flags.places.size());
        Measurement one{flags.name, what.kind, {}};
        for (const std::string& text : flags.places) {
            const auto place = geo::parse_lat_lon(text);
            if (!place) return place.error();
            one.vertices.push_back(*place);
        }
        return std::vector{one};
    }
    if (!flags.places.empty())
        return Error{ErrorKind::usage, "places are in the command or in a file (--from), not in both"};
    auto all = output::load_measurements(flags.from);
    if (!all) return all.error();
    const std::size_t found = all->size();
    std::erase_if(*all, [&](const Measurement& m) {
        return m.kind != what.kind || m.vertices.size() < what.least || m.vertices.size() > what.most;
    });
    if (all->empty())
        return Error{ErrorKind::input,
                     fmt::format("{}: none of its {} measurements is one of {} for measure {}", flags.from,
                                 found, what.needs, what.name)};
    return all;
}

Result<Json> measure(const MeasureFlags& flags, lod::HeightSampler& sampler, const Measurement& one) {
    if (flags.what == "point") return measure_point(flags, sampler, one.vertices.front());
    if (flags.what == "profile") return measure_profile(flags, sampler, one.vertices);
    if (flags.what == "area") return measure_area(flags, sampler, one.vertices);
    if (flags.what == "sight") return measure_sight(flags, sampler, one.vertices);
    if (flags.what == "viewshed") return measure_viewshed(flags, sampler, one.vertices.front());
    return measure_path(flags, sampler, one.vertices);
}

/// As a file has it: with H at each vertex, and without a profile's thousands of samples.
Result<output::MeasurementRecord> record_of(lod::HeightSampler& sampler, const Measurement& one,
                                            Json results) {
    output::MeasurementRecord record{one, {}, std::move(results)};
    record.results.erase("samples");
    for (const geo::LatLon& place : one.vertices) {
        const auto H = sampler.height(sampler.scene().info().frame.grid_position(place));
        if (!H) return H.error();
        record.H_m.push_back(*H);
    }
    return record;
}

Result<void> check_flags(const MeasureFlags& flags) {
    if (flags.what == "viewshed" && !(flags.radius_m > 0))
        return Error{ErrorKind::usage, "measure viewshed needs --radius METRES"};
    if (flags.what == "viewshed" && !flags.from.empty())
        return Error{ErrorKind::usage, "measure viewshed takes one place from the command, not --from"};
    if (const auto plane = lod::parse_plane(flags.plane); !plane)
        return Error{ErrorKind::usage, "--plane: " + plane.error().message};
    if (!flags.save.empty() && !output::is_measurement_file(flags.save))
        return Error{
            ErrorKind::usage,
            fmt::format("--save {}: the name must end in .geojson, .json, .csv or .kml", flags.save)};
    return {};
}

Result<void> run(const MeasureFlags& flags) {
    if (auto good = check_flags(flags); !good) return good;
    const auto measurements = wanted(flags);
    if (!measurements) return measurements.error();
    const auto scene = lod::Scene::open(flags.scene);
    if (!scene) return scene.error();
    lod::HeightSampler sampler(*scene);

    std::vector<output::MeasurementRecord> records;
    Json list = Json::array();
    for (const Measurement& one : *measurements) {
        const bool named = !flags.from.empty() && !flags.common.json && flags.format == "text";
        if (named) fmt::print("{}{}\n", list.empty() ? "" : "\n", one.name.empty() ? "(no name)" : one.name);
        auto results = measure(flags, sampler, one);
        if (!results) {
            if (flags.from.empty()) return results.error();
            return Error{results.error().kind,
                         fmt::format("{}: \"{}\": {}", flags.from, one.name, results.error().message)};
        }
        if (!flags.save.empty()) {
            auto record = record_of(sampler, one, *results);
            if (!record) return record.error();
            records.push_back(*std::move(record));
        }
        if (!flags.from.empty()) (*results)["name"] = one.name;
        list.push_back(*std::move(results));
    }
    if (!flags.save.empty()) {
        if (auto saved = output::save_measurements(flags.save, records, flags.overwrite); !saved)
            return saved;
    }
    if (!flags.common.json) return {};
    const Json json = flags.from.empty() ? std::move(list.front()) : Json{{"measurements", std::move(list)}};
    fmt::print("{}\n", json.dump(-1, ' ', false, Json::error_handler_t::replace));
    return {};
}

}  // namespace

void add_measure(CLI::App& program, Action& action) {
    auto flags = std::make_shared<MeasureFlags>();
    CLI::App* command = program.add_subcommand(
        "measure", "Coordinates, heights, lengths, profiles, areas, volumes, lines of sight");
    command->add_option("SCENE", flags->scene, "The scene")->required();
    command->add_option("WHAT", flags->what, "point, line, path, profile, area, sight or viewshed")
        ->required()
        ->check(CLI::IsMember({"point", "line", "path", "profile", "area", "sight", "viewshed"}));
    command->add_option(
        "PLACE", flags->places,
        "LAT,LON in decimal degrees, or degrees, minutes and seconds, UTM/UPS or MGRS; as many as it takes");
    command->add_option("--from", flags->from, "Measure what a .geojson, .csv or .kml file has")
        ->type_name("FILE");
    command->add_option("--save", flags->save, "Write places and results to such a file")->type_name("FILE");
    command->add_option("--name", flags->name, "Of the measurement in the file")->type_name("TEXT");
    command->add_option("--units", flags->units, "Of the text; JSON and files are in metres always")
        ->check(CLI::IsMember({"metric", "imperial", "nautical"}))
        ->capture_default_str();
    command->add_option("--format", flags->format, "Of a profile's text: a summary, or its samples as CSV")
        ->check(CLI::IsMember({"text", "csv"}))
        ->capture_default_str();
    command
        ->add_option(
            "--plane", flags->plane,
            "area: what volumes are above and below: its lowest H, the lowest on its border, its mean "
            "H, or a given one")
        ->type_name("lowest|border|mean|METRES")
        ->capture_default_str();
    command->add_option("--eye-height", flags->looking.eye_height_m, "sight, viewshed: above the ground")
        ->type_name("METRES")
        ->capture_default_str();
    command
        ->add_option("--target-height", flags->looking.target_height_m, "sight, viewshed: above the ground")
        ->type_name("METRES")
        ->capture_default_str();
    command->add_option("--refraction", flags->looking.refraction, "sight, viewshed: coefficient of the air")
        ->type_name("K")
        ->capture_default_str();
    command->add_option("--radius", flags->radius_m, "viewshed: how far one looks")->type_name("METRES");
    command->add_option("-o,--output", flags->output, "viewshed: a GeoTIFF of it")->type_name("FILE");
    command->add_flag("--overwrite", flags->overwrite, "Replace files of these names");
    add_common(*command, flags->common);
    command->footer(
        "Examples:\n"
        "  relevo measure dunes.relevo point 37.7397,-105.5146\n"
        "  relevo measure dunes.relevo point \"13S DB 54655 76935\" --json\n"
        "  relevo measure dunes.relevo line 37.7397,-105.5146 37.5775,-105.4856\n"
        "  relevo measure dunes.relevo profile 37.7397,-105.5146 37.5775,-105.4856 --format csv\n"
        "  relevo measure dunes.relevo area 37.72,-105.6 37.72,-105.5 37.8,-105.55 --units imperial\n"
        "  relevo measure dunes.relevo sight 37.7397,-105.5146 37.5775,-105.4856\n"
        "  relevo measure dunes.relevo viewshed 37.5775,-105.4856 --radius 20000 -o seen.tif\n\n"
        "Heights come from the full data, bilinear between posts; lengths are geodesics on WGS 84.");
    command->callback([flags, &action] { action = [flags] { return run(*flags); }; });
}

}  // namespace relevo::app
