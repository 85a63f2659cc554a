#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/cog.hpp"
#include "output/export_mesh.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/stop_on_signal.hpp"

namespace relevo::app {
namespace {

using Json = nlohmann::ordered_json;

struct ExportFlags {
    std::filesystem::path scene;
    std::filesystem::path output;
    std::optional<double> max_error;
    std::vector<double> bounds;
    std::string coordinates = "enu";
    std::string heights = "datum";
    std::string compression = "deflate";
    bool tif = false;
    bool overwrite = false;
    std::uint64_t memory = std::uint64_t{1} << 30;
    Common common;
};

Error usage(std::string what) {
    return {ErrorKind::usage, std::move(what)};
}

std::string extension(const ExportFlags& flags) {
    std::string text = flags.output.extension().string();
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_raster(const ExportFlags& flags) {
    return flags.tif || extension(flags) == ".tif" || extension(flags) == ".tiff";
}

Result<output::MeshFormat> mesh_format(const ExportFlags& flags) {
    if (extension(flags) == ".ply") return output::MeshFormat::ply;
    if (extension(flags) == ".glb") return output::MeshFormat::glb;
    if (extension(flags) == ".obj") return output::MeshFormat::obj;
    return usage(
        fmt::format("{}: the name says what to write: .ply, .glb or .obj for a mesh, .tif for heights",
                    flags.output.string()));
}

output::Coordinates coordinates_of(const ExportFlags& flags) {
    using output::Coordinates;
    for (const auto kind : {Coordinates::geodetic, Coordinates::ecef, Coordinates::source})
        if (flags.coordinates == to_string(kind)) return kind;
    return Coordinates::enu;
}

std::optional<output::Bounds> bounds_of(const ExportFlags& flags) {
    if (flags.bounds.size() != 4) return {};
    return output::Bounds{flags.bounds[0], flags.bounds[1], flags.bounds[2], flags.bounds[3]};
}

Json extent_json(const geo::GridFrame& frame) {
    const geo::GridFrame::Extent extent = frame.extent();
    return {{"west", extent.west}, {"south", extent.south}, {"east", extent.east}, {"north", extent.north}};
}

Result<void> run_mesh(const ExportFlags& flags) {
    const auto format = mesh_format(flags);
    if (!format) return format.error();
    if (!flags.max_error)
        return usage("how exact? Give --max-error METRES: no post will be farther from the mesh");
    if (!(*flags.max_error >= 0) || std::isinf(*flags.max_error))
        return usage(fmt::format("--max-error {}: expected metres, 0 or more", *flags.max_error));
    const auto scene = lod::Scene::open(flags.scene);
    if (!scene) return scene.error();

    const StopOnSignal signals;
    const auto bar = progress_bar(flags.common, "writing");
    output::MeshRequest request;
    request.format = *format;
    request.max_error_m = *flags.max_error;
    request.coordinates = coordinates_of(flags);
    request.heights = flags.heights == "ellipsoid" ? output::Heights::ellipsoid : output::Heights::datum;
    request.bounds = bounds_of(flags);
    request.memory_bytes = flags.memory;
    request.path = flags.output;
    request.overwrite = flags.overwrite;
    request.generator = fmt::format("relevo {}", RELEVO_VERSION);
    request.progress = [&](double done) {
        bar(done);
        return !signals.stop_asked();
    };
    const auto exported = output::export_mesh(*scene, request);
    if (!exported) return exported.error();
    if (flags.common.json) {
        Json json{{"file", flags.output.string()},      {"triangles", exported->triangles},
                  {"vertices", exported->vertices},     {"seconds", exported->mesh_s},
                  {"read_seconds", exported->read_s},   {"measure_seconds", exported->measure_s},
                  {"write_seconds", exported->write_s}, {"bytes", exported->bytes}};
        json.update(exported->about);
        fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
        return {};
    }
    fmt::print("{}: {} triangles and {} vertices over {} x {} posts, {:.1f} MiB\n", flags.output.string(),
               exported->triangles, exported->vertices, exported->box.columns, exported->box.rows,
               static_cast<double>(exported->bytes) / 1048576);
    fmt::print("measured error {}: at most {:.6g} m, RMS {:.6g} m, over {} posts\n",
               exported->about["error"].get<std::string>(), exported->error.max_m, exported->error.rms_m,
               exported->error.posts);
    fmt::print("read in {:.2f} s, made in {:.2f} s, measured in {:.2f} s, written in {:.2f} s\n",
               exported->read_s, exported->mesh_s, exported->measure_s, exported->write_s);
    return {};
}

Result<void> run_raster(const ExportFlags& flags) {
    if (flags.max_error) return usage("--max-error is for meshes: heights in a GeoTIFF are exact");
    const auto scene = lod::Scene::open(flags.scene);
    if (!scene) return scene.error();
    const geo::GridFrame& frame = scene->info().frame;
    lod::BlockGrid::Box box{0, 0, frame.columns, frame.rows};
    if (const auto bounds = bounds_of(flags)) {
        const auto part = output::posts_around(frame, *bounds);
        if (!part) return part.error();
        box = *part;
    }
    auto file = output::PartialFile::create(flags.output, flags.overwrite);
    if (!file) return file.error();

    const StopOnSignal signals;
    const auto bar = progress_bar(flags.common, "writing");
    output::CogRequest request;
    request.compression = flags.compression == "zstd" ? "ZSTD" : "DEFLATE";
    request.cache_bytes = flags.memory / 4;
    request.progress = [&](double done) {
        bar(done);
        return !signals.stop_asked();
    };
    const auto start = std::chrono::steady_clock::now();
    if (auto done = output::write_cog(*scene, box, request, *file); !done) return done;
    const std::uint64_t bytes = file->bytes();
    if (auto done = file->take(); !done) return done;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (flags.common.json) {
        const Json json{{"file", flags.output.string()},
                        {"triangles", nullptr},
                        {"vertices", nullptr},
                        {"max_error_m", nullptr},
                        {"rms_error_m", nullptr},
                        {"seconds", seconds},
                        {"bytes", bytes},
                        {"columns", box.columns},
                        {"rows", box.rows},
                        {"extent", extent_json(output::frame_of(frame, box))},
                        {"vertical_datum", scene->info().vertical.name}};
        fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
        return {};
    }
    fmt::print("{}: {} x {} posts, {:.1f} MiB in {:.2f} s\n", flags.output.string(), box.columns, box.rows,
               static_cast<double>(bytes) / 1048576, seconds);
    return {};
}

}  // namespace

void add_export(CLI::App& program, Action& action) {
    auto flags = std::make_shared<ExportFlags>();
    CLI::App* command =
        program.add_subcommand("export", "A mesh within a stated error, or heights, for other programs");
    command->footer(
        "Examples:\n  relevo export fuji.relevo -o fuji.glb --max-error 5\n"
        "  relevo export fuji.relevo -o summit.ply --max-error 1 --bounds 138.7,35.34,138.76,35.38 "
        "--coordinates geodetic\n  relevo export fuji.relevo -o fuji.tif");
    command->add_option("SCENE", flags->scene, "A scene made by relevo ingest")->required();
    command
        ->add_option("-o,--output", flags->output,
                     "What to write: .ply, .glb or .obj is a mesh, .tif heights (cloud-optimised GeoTIFF)")
        ->required()
        ->type_name("FILE");
    command->add_option("--max-error", flags->max_error, "Metres that no post is farther from the mesh");
    command
        ->add_option(
            "--bounds", flags->bounds,
            "Only this part, in degrees, snapped outwards to posts; W above E lies across the antimeridian")
        ->type_name("W,S,E,N")
        ->delimiter(',')
        ->expected(4);
    command
        ->add_option(
            "--coordinates", flags->coordinates,
            "enu: metres around the middle; ecef; geodetic: lon, lat, height; source: the first source's CRS")
        ->check(CLI::IsMember({"enu", "ecef", "geodetic", "source"}))
        ->capture_default_str();
    command
        ->add_option("--heights", flags->heights,
                     "Of geodetic and source coordinates: above the scene's vertical datum, or the ellipsoid")
        ->check(CLI::IsMember({"datum", "ellipsoid"}))
        ->capture_default_str();
    command->add_flag("--tif", flags->tif, "Heights as a GeoTIFF, whatever the name's ending");
    command
        ->add_option("--compress", flags->compression,
                     "Of a GeoTIFF: zstd is smaller, deflate known everywhere")
        ->check(CLI::IsMember({"deflate", "zstd"}))
        ->capture_default_str();
    command->add_option("--memory", flags->memory, "Most memory to take, e.g. 512MiB")
        ->transform(CLI::AsSizeValue(false))
        ->default_str("1GiB");
    command->add_flag("--overwrite", flags->overwrite, "Replace a file of that name");
    add_common(*command, flags->common);
    command->callback([flags, &action] {
        action = [flags] { return is_raster(*flags) ? run_raster(*flags) : run_mesh(*flags); };
    });
}

}  // namespace relevo::app
