#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/machine_report.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::app {
namespace {

struct Settings {
    Common common;
    std::string scene;
    bool machine = false;
};

/// What follows from a scene's description.
struct Derived {
    geo::GridFrame::Extent extent;
    geo::GridFrame::Spacing spacing;
    std::uint64_t posts = 0;
    std::uint64_t height_bytes = 0;
    std::uint64_t metric_bytes = 0;

    explicit Derived(const lod::SceneInfo& info)
        : extent(info.frame.extent()),
          spacing(info.frame.spacing({(info.frame.columns - 1) / 2.0, (info.frame.rows - 1) / 2.0})),
          posts(info.valid_posts + info.void_posts),
          height_bytes(lod::bytes_of(info.heights)) {
        for (const lod::LevelInfo& level : info.levels) {
            height_bytes += lod::bytes_of(level.heights);
            metric_bytes += lod::bytes_of(level.vertices);
        }
    }

    double per_post(std::uint64_t bytes) const {
        return static_cast<double>(bytes) / static_cast<double>(posts);
    }
};

nlohmann::json info_json(const lod::SceneInfo& info, const Derived& derived) {
    nlohmann::json json = lod::to_json(info);
    for (const char* only_on_disk : {"heights", "marks", "levels", "geoid", "block_side", "vertical_name"}) {
        json.erase(only_on_disk);
    }
    json["extent"] = {{"west", derived.extent.west},
                      {"south", derived.extent.south},
                      {"east", derived.extent.east},
                      {"north", derived.extent.north}};
    const geo::GridFrame& frame = info.frame;
    json["n"] = frame.levels();
    json["columns"] = frame.columns;
    json["rows"] = frame.rows;
    json["step_x"] = frame.step_x;
    json["step_y"] = frame.step_y;
    json["step_unit"] = lod::step_unit(frame.kind);
    json["step_x_m"] = derived.spacing.column_m;
    json["step_y_m"] = derived.spacing.row_m;
    json["vertical_datum"] = info.vertical.name;
    if (info.valid_posts == 0) json["height_min_m"] = json["height_max_m"] = nullptr;
    json["bytes"] = info.bytes();
    json["bytes_per_post"] = derived.per_post(info.bytes());
    json["height_bytes_per_post"] = derived.per_post(derived.height_bytes);
    json["metric_bytes_per_post"] = derived.per_post(derived.metric_bytes);
    return json;
}

std::string degrees(double value, char positive, char negative) {
    return fmt::format("{:.7f} {}", value < 0 ? -value : value, value < 0 ? negative : positive);
}

std::string longitude(double lon) {
    return degrees(geo::wrapped_180(geo::Degrees{lon}).value, 'E', 'W');
}

std::string longitudes(const geo::GridFrame::Extent& extent) {
    if (extent.east - extent.west >= 360) return "all longitudes";
    return fmt::format("{} to {}", longitude(extent.west), longitude(extent.east));
}

std::string mebibytes(std::uint64_t bytes) {
    return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
}

/// \param with_notes  those of several sources stand in the scene's notes, together where they are the same
void print_source(const lod::SourceInfo& source, bool with_notes) {
    fmt::print("source       {}: {} x {} posts, {:.10g} x {:.10g} {}, {}\n", source.name, source.columns,
               source.rows, source.step_x, source.step_y, source.step_unit, source.crs);
    fmt::print("             to WGS 84: {}{}\n", source.operation,
               source.operation_accuracy_m
                   ? fmt::format(", accuracy {:.3g} m as stated by PROJ", *source.operation_accuracy_m)
                   : ", accuracy unknown");
    if (!source.operation_note.empty()) fmt::print("             {}\n", source.operation_note);
    if (with_notes && !source.notes.empty()) fmt::print("             {}\n", source.notes);
    fmt::print("             SHA-256 {}\n", source.sha256);
}

void print_resampling(const lod::SceneInfo& info) {
    if (info.resampling_method == "none") {
        fmt::print("resampling   none: the source's own posts, {}\n",
                   info.max_height_error_m > 0
                       ? fmt::format("stored with at most {:.3g} m of loss", info.max_height_error_m)
                   : info.resampling.max_m == 0 ? "bit for bit"
                                                : "rounded to float32");
        return;
    }
    const lod::ResamplingError& error = info.resampling;
    fmt::print("resampling   {}; scene against {} source posts: {:.3g} m RMS, {:.3g} m at most\n",
               info.resampling_method, error.posts, error.rms_m, error.max_m);
    if (error.lost_posts > 0)
        fmt::print("             {} source posts have no height here\n", error.lost_posts);
}

void print_outliers(const lod::SceneInfo& info) {
    if (info.outlier_posts == 0) return;
    const lod::OutlierInfo& worst = info.outliers.front();
    const geo::LatLon place =
        info.frame.lat_lon({static_cast<double>(worst.column), static_cast<double>(worst.row)});
    fmt::print(
        "outliers     {}; the farthest from its surroundings: {:.6g} m at {:.6f},{:.6f}, median {:.6g} m\n",
        info.outlier_posts, worst.H_m, place.lat.value, geo::wrapped_180(place.lon).value, worst.median_m);
}

void print_seams(const lod::SceneInfo& info) {
    constexpr std::size_t kShown = 10;
    for (std::size_t i = 0; i < std::min(info.seams.size(), kShown); ++i) {
        const lod::SeamInfo& seam = info.seams[i];
        const auto name = [&](int source) {
            const auto index = static_cast<std::size_t>(source);
            return index < info.sources.size() ? info.sources[index].name : std::string("other sources");
        };
        fmt::print("seam         {} - {}: largest step {:.3g} m, {:.3g} m RMS\n", name(seam.first),
                   name(seam.second), seam.max_step_m, seam.rms_step_m);
    }
    if (info.seams.size() > kShown)
        fmt::print("             and {} seams more (--json)\n", info.seams.size() - kShown);
}

void print_text(const std::string& name, const lod::SceneInfo& info, const Derived& derived) {
    const geo::GridFrame& frame = info.frame;
    fmt::print("scene        {}, format version {}\n", name, lod::SceneInfo::kFormatVersion);
    fmt::print("extent       {} to {}, {}\n", degrees(derived.extent.south, 'N', 'S'),
               degrees(derived.extent.north, 'N', 'S'), longitudes(derived.extent));
    fmt::print("grid         {} x {} posts, {} (WGS 84), n = {}\n", frame.columns, frame.rows,
               lod::to_string(frame.kind), frame.levels());
    fmt::print("resolution   {:.10g} x {:.10g} {}, {:.2f} x {:.2f} m in the middle\n", frame.step_x,
               frame.step_y, lod::step_unit(frame.kind), derived.spacing.column_m, derived.spacing.row_m);
    fmt::print("heights      above {}{}, {}\n", info.vertical.name,
               info.vertical.assumed ? " (assumed: the source does not say)" : "",
               info.height_type == lod::HeightType::int16 ? "whole metres" : "32-bit floats");
    if (info.valid_posts > 0)
        fmt::print("             {:.10g} to {:.10g} m\n", info.height_min_m, info.height_max_m);
    fmt::print("posts        {} with a height, {} void\n", info.valid_posts, info.void_posts);
    if (info.filled_posts > 0)
        fmt::print("             {} filled over voids or outliers\n", info.filled_posts);
    fmt::print("sea          {} posts, {} of them with a made-up bed: {}\n", info.sea_posts,
               info.modelled_posts, info.sea.text);
    print_outliers(info);
    print_resampling(info);
    fmt::print("surface      bilinear (measured) and triangles (drawn) differ by at most {:.3g} m\n",
               info.bilinear_mesh_max_m);
    for (const lod::SourceInfo& source : info.sources) print_source(source, info.notes.empty());
    print_seams(info);
    for (const std::string& note : info.notes) fmt::print("note         {}\n", note);
    fmt::print("size         {}, {:.2f} bytes a post (heights {:.2f}, errors and radii {:.2f})\n",
               mebibytes(info.bytes()), derived.per_post(info.bytes()),
               derived.per_post(derived.height_bytes), derived.per_post(derived.metric_bytes));
}

Result<void> show(const Settings& settings) {
    const auto scene = lod::Scene::open(settings.scene);
    if (!scene) return scene.error();
    const Derived derived(scene->info());
    std::optional<MachineReport> machine;
    if (settings.machine) machine = machine_report(settings.scene);
    if (settings.common.json) {
        auto json = info_json(scene->info(), derived);
        if (machine) json["machine"] = machine->json;
        fmt::print("{}\n", json.dump());
    } else {
        print_text(settings.scene, scene->info(), derived);
        if (machine) fmt::print("{}", machine->text);
    }
    return {};
}

}  // namespace

void add_info(CLI::App& program, Action& action) {
    const auto settings = std::make_shared<Settings>();
    CLI::App* command = program.add_subcommand("info", "What is in a scene");
    command->footer("Example: relevo info fuji.relevo");
    add_common(*command, settings->common);
    command->add_option("scene", settings->scene, "A scene made by relevo ingest")
        ->required()
        ->type_name("SCENE");
    command->add_flag("--machine", settings->machine,
                      "Also what this machine has, and the caches that --memory auto takes for pictures");
    command->callback([settings, &action] { action = [settings] { return show(*settings); }; });
}

}  // namespace relevo::app
