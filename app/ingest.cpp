#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/source_flags.hpp"
#include "app/stop_on_signal.hpp"
#include "ingest/import.hpp"
#include "ingest/reference/vertical_datum.hpp"
#include "ingest/source/inputs.hpp"
#include "lod/lstr/chunk_file.hpp"

namespace relevo::app {
namespace {

struct Settings {
    Common common;
    std::vector<std::string> inputs;
    std::string scene;
    bool overwrite = false;
    bool dry_run = false;
    std::optional<std::string> crs;
    std::vector<double> bounds;
    std::optional<double> nodata;
    std::optional<double> height_scale;
    double height_offset = 0;
    std::string vertical;
    SourceFlags source;
    std::string frame = "auto";
    std::string datum;
    std::string geoid;
    std::string priority = "finest";
    double feather = 0;
    std::string sea;
    int fill = 0;
    bool despike = false;
    std::string errors = "bounded";
    double max_height_error = 0;
    std::uint64_t memory = std::uint64_t{1} << 30;
    bool resume = false;
    bool chunks = false;
    std::string resampling;
    std::vector<double> resolution;
    std::vector<double> crop;
    std::uint64_t max_posts = ingest::ImportOptions::kMostPosts;
};

std::optional<ingest::Bounds> bounds_of(const std::vector<double>& numbers) {
    if (numbers.size() != 4) return {};
    return ingest::Bounds{numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::optional<lod::VerticalDatum> datum_from(const std::string& name) {
    if (name == "egm96") return lod::VerticalDatum::egm96;
    if (name == "ellipsoid") return lod::VerticalDatum::ellipsoid;
    return {};
}

ingest::SourceRequest source_of(const Settings& s, const std::string& input) {
    ingest::SourceRequest source;
    source.input = input;
    source.crs = s.crs;
    source.bounds = bounds_of(s.bounds);
    source.nodata = s.nodata;
    source.height_scale = s.height_scale;
    source.height_offset = s.height_offset;
    source.vertical = datum_from(s.vertical);
    s.source.apply(source);
    return source;
}

Result<ingest::ImportOptions> options_of(const Settings& s) {
    const auto inputs = ingest::expand_inputs(s.inputs);
    if (!inputs) return inputs.error();
    ingest::ImportOptions options;
    ingest::MosaicRequest& mosaic = options.mosaic;
    for (const std::string& input : *inputs) mosaic.sources.push_back(source_of(s, input));
    mosaic.target.crop = bounds_of(s.crop);
    if (!s.resolution.empty()) mosaic.target.resolution = {s.resolution.front(), s.resolution.back()};
    if (s.frame == "geographic") mosaic.target.frame = ingest::FrameChoice::geographic;
    if (s.frame == "ups") mosaic.target.frame = ingest::FrameChoice::ups;
    mosaic.resampling = ingest::resampling_from(s.resampling);
    mosaic.priority = s.priority == "order" ? ingest::Priority::order : ingest::Priority::finest;
    mosaic.feather_m = s.feather;
    if (!s.datum.empty()) {
        auto datum = ingest::vertical_reference_named(s.datum);
        if (!datum) return datum.error();
        mosaic.datum = std::move(*datum);
    }
    if (!s.geoid.empty()) mosaic.geoid = s.geoid;
    options.sea = ingest::sea_request_from(s.sea);
    options.fill_width = s.fill;
    options.despike = s.despike;
    options.max_height_error_m = s.max_height_error;
    options.bounded_errors = s.errors == "bounded";
    options.memory_bytes = s.memory;
    options.max_posts = s.max_posts;
    return options;
}

void print_notes(const Settings& s, const std::vector<std::string>& notes) {
    if (s.common.quiet) return;
    for (const auto& note : notes) fmt::print(stderr, "relevo: note: {}\n", note);
}

nlohmann::json frame_json(const geo::GridFrame& frame) {
    const geo::GridFrame::Extent extent = frame.extent();
    return {
        {"columns", frame.columns},
        {"rows", frame.rows},
        {"frame", lod::to_string(frame.kind)},
        {"step_x", frame.step_x},
        {"step_y", frame.step_y},
        {"step_unit", lod::step_unit(frame.kind)},
        {"extent",
         {{"west", extent.west}, {"south", extent.south}, {"east", extent.east}, {"north", extent.north}}}};
}

nlohmann::json plan_json(const ingest::ImportPlan& plan) {
    nlohmann::json json = frame_json(plan.frame);
    json["dry_run"] = true;
    json["posts"] = plan.posts;
    json["padded_posts"] = plan.padded_posts;
    json["bytes_estimate"] = plan.bytes_estimate;
    json["memory_bytes"] = plan.memory_bytes;
    json["resampling_method"] = plan.resampling;
    json["vertical_datum"] = plan.vertical.name;
    json["vertical_assumed"] = plan.vertical.assumed;
    json["sources"] = nlohmann::json::array();
    for (const lod::SourceInfo& source : plan.sources) {
        json["sources"].push_back({{"name", source.name},
                                   {"crs", source.crs},
                                   {"operation", source.operation},
                                   {"operation_accuracy_m", nullptr}});
        if (source.operation_accuracy_m)
            json["sources"].back()["operation_accuracy_m"] = *source.operation_accuracy_m;
    }
    json["notes"] = plan.notes;
    return json;
}

Result<void> show_plan(const Settings& s) {
    const auto options = options_of(s);
    if (!options) return options.error();
    const auto plan = ingest::plan_import(*options);
    if (!plan) return plan.error();
    print_notes(s, plan->notes);
    if (s.common.json) {
        fmt::print("{}\n", plan_json(*plan).dump(2));
        return {};
    }
    fmt::print("{} x {} posts, step {:.10g} x {:.10g} {} ({})\n", plan->frame.columns, plan->frame.rows,
               plan->frame.step_x, plan->frame.step_y, lod::step_unit(plan->frame.kind),
               plan->resampling == "none" ? "the sources' own" : "resampled: " + plan->resampling);
    fmt::print("{} posts, {} with padding; about {:.1f} MiB on disk; at least {:.1f} MiB of memory\n",
               plan->posts, plan->padded_posts, static_cast<double>(plan->bytes_estimate) / 1048576,
               static_cast<double>(plan->memory_bytes) / 1048576);
    if (plan->padded_posts > s.max_posts)
        fmt::print("more than --max-posts {}: it would be refused\n", s.max_posts);
    return {};
}

nlohmann::json imported_json(const Settings& s, const ingest::Imported& imported, double seconds) {
    const lod::SceneInfo& info = imported.info;
    nlohmann::json json = frame_json(info.frame);
    const auto posts = info.valid_posts + info.void_posts;
    json["scene"] = s.scene;
    json["posts"] = posts;
    json["valid_posts"] = info.valid_posts;
    json["void_posts"] = info.void_posts;
    json["height_min_m"] = info.height_min_m;
    json["height_max_m"] = info.height_max_m;
    json["vertical_datum"] = info.vertical.name;
    json["vertical_assumed"] = info.vertical.assumed;
    json["resampling"] = {{"method", info.resampling_method},
                          {"rms_m", info.resampling.rms_m},
                          {"max_m", info.resampling.max_m},
                          {"posts", info.resampling.posts},
                          {"lost_posts", info.resampling.lost_posts}};
    json["bytes"] = info.bytes();
    json["bytes_per_post"] = static_cast<double>(info.bytes()) / static_cast<double>(posts);
    json["seconds"] = seconds;
    json["notes"] = imported.notes;
    return json;
}

Result<ingest::Imported> import(const Settings& s) {
    const StopOnSignal signals;
    const auto bar = progress_bar(s.common, "importing");
    const auto options = options_of(s);
    if (!options) return options.error();
    const ingest::ImportPlace place{std::filesystem::absolute(s.scene), s.overwrite, s.resume};
    return ingest::import_scene(*options, place, [&](double done) {
        bar(done);
        return !signals.stop_asked();
    });
}

Result<void> add_quadtree(const Settings& s) {
    const auto scene = lod::Scene::open(s.scene);
    if (!scene) return scene.error();
    const auto terrain = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, {});
    if (!terrain) return terrain.error();
    return make_chunks(*scene, *terrain, {lod::chunk_errors(*terrain)}, s.common);
}

Result<void> run_import(const Settings& s) {
    const auto start = std::chrono::steady_clock::now();
    const auto imported = import(s);
    if (!imported) return imported.error();
    if (s.chunks) {
        if (auto done = add_quadtree(s); !done) return done;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    print_notes(s, imported->notes);
    const lod::SceneInfo& info = imported->info;
    if (s.common.json) {
        fmt::print("{}\n", imported_json(s, *imported, seconds).dump(2));
        return {};
    }
    fmt::print("{}: {} x {} posts, {:.2f} to {:.2f} m above {}\n", s.scene, info.frame.columns,
               info.frame.rows, info.height_min_m, info.height_max_m, info.vertical.name);
    if (info.resampling_method != "none")
        fmt::print("resampled ({}): {:.3f} m RMS and {:.3f} m at most from the source's posts\n",
                   info.resampling_method, info.resampling.rms_m, info.resampling.max_m);
    fmt::print("{:.1f} MiB in {:.2f} s\n", static_cast<double>(info.bytes()) / 1048576, seconds);
    return {};
}

Result<void> run(const Settings& s) {
    if (!s.dry_run && s.scene.empty())
        return Error{ErrorKind::usage, "where to? Give the scene's name with -o"};
    for (const double step : s.resolution)
        if (!(step > 0)) return Error{ErrorKind::usage, "--resolution: steps greater than 0"};
    return s.dry_run ? show_plan(s) : run_import(s);
}

}  // namespace

void add_ingest(CLI::App& program, Action& action) {
    auto settings = std::make_shared<Settings>();
    Settings& s = *settings;
    CLI::App& command = *program.add_subcommand("ingest", "Import elevation files as one scene");
    command
        .add_option("INPUT", s.inputs,
                    "Elevation files, folders of them, VRTs, zipped tiles, or @LIST: a text file of these")
        ->required();
    command.add_option("-o,--output", s.scene, "The scene to make, NAME.relevo");
    command.add_flag("--overwrite", s.overwrite, "Replace a scene of that name");
    command.add_flag("--resume", s.resume, "Go on from what the same import has left when it was stopped");
    command.add_flag("--chunks", s.chunks, "Make what `--lod lstr` draws, too: else it is made on first use");
    command.add_flag("--dry-run", s.dry_run, "Say what would be made (posts, bytes), and make nothing");
    command.add_option("--crs", s.crs,
                       "Coordinate reference system of the file, e.g. EPSG:32611, in place of its own");
    command.add_option("--bounds", s.bounds, "Where the file is: outer edges of its pixels in its CRS")
        ->type_name("W,S,E,N")
        ->delimiter(',')
        ->expected(4);
    command.add_option("--nodata", s.nodata, "The value that means void, in place of the file's own");
    command.add_option("--height-scale", s.height_scale,
                       "Metres per unit of the file's heights (0.3048 for feet)");
    command.add_option("--height-offset", s.height_offset, "Metres added to heights");
    command.add_option("--vertical", s.vertical, "What heights are above, in place of what the file says")
        ->check(CLI::IsMember({"egm96", "ellipsoid"}));
    s.source.add_to(command);
    command.add_option("--datum", s.datum,
                       "What the scene's heights are above: egm96, ellipsoid, or a datum that PROJ "
                       "knows; default: the finest source's");
    command.add_option("--geoid", s.geoid, "A grid of undulations for heights above another datum");
    command.add_option("--priority", s.priority, "Where inputs overlap: the finest wins, or the first given")
        ->check(CLI::IsMember({"finest", "order"}))
        ->capture_default_str();
    command.add_option("--feather", s.feather, "Blend the border of finer data over this many metres");
    command.add_option("--resampling", s.resampling, "Default: cubic, or average where the scene is coarser")
        ->check(CLI::IsMember({"cubic", "bilinear", "nearest", "average"}));
    command.add_option("--frame", s.frame, "The scene's grid; auto: UPS beyond 75 degrees, else geographic")
        ->check(CLI::IsMember({"auto", "geographic", "ups"}))
        ->capture_default_str();
    command
        .add_option("--resolution", s.resolution,
                    "Steps in place of the finest file's: degrees of longitude and latitude, metres in UPS")
        ->type_name("X[,Y]")
        ->delimiter(',')
        ->expected(1, 2);
    command
        .add_option("--crop", s.crop, "Only this part, in degrees; W above E lies across the antimeridian")
        ->type_name("W,S,E,N")
        ->delimiter(',')
        ->expected(4);
    command
        .add_option("--sea", s.sea,
                    "auto, depths, none, or a file of polygons or a raster that says where the sea is; "
                    "default: as auto, but bathymetry is land")
        ->type_name("auto|depths|none|FILE");
    command.add_option("--fill", s.fill, "Interpolate voids up to this many posts wide")
        ->check(CLI::Range(0, 255));
    command.add_flag("--despike", s.despike, "Put the median of the posts around them in place of outliers");
    command
        .add_option("--errors", s.errors, "Errors to build: bounded (and incremental), or incremental alone")
        ->check(CLI::IsMember({"bounded", "incremental"}))
        ->capture_default_str();
    command
        .add_option("--max-height-error", s.max_height_error,
                    "Metres by which heights may be changed so that they take less disk (LERC)")
        ->check(CLI::NonNegativeNumber);
    command.add_option("--memory", s.memory, "Most memory to take, e.g. 512MiB")
        ->transform(CLI::AsSizeValue(false))
        ->default_str("1GiB");
    command.add_option("--max-posts", s.max_posts, "Refuse scenes whose padded grid is larger")
        ->capture_default_str();
    add_common(command, s.common);
    command.footer(
        "Example:\n  relevo ingest everest.tif -o everest.relevo\n"
        "  relevo ingest trinidad.nc --crs EPSG:4326 --height-scale 0.3048 -o trinidad.relevo");
    command.callback([&action, settings] { action = [settings] { return run(*settings); }; });
}

}  // namespace relevo::app
