#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/drape_flags.hpp"
#include "app/ground_map_flag.hpp"
#include "app/overlay_json.hpp"
#include "app/render_frames.hpp"
#include "app/view_flags.hpp"
#include "viewer/bench/machine.hpp"
#include "viewer/numbers.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/picture_notes.hpp"

namespace relevo::app {

namespace {

struct RenderFlags {
    std::string scene;
    std::string output;
    std::optional<std::string> background, play;
    double fps = 30;
    bool measure_error = false;
    ViewFlags view;
    BudgetFlags budget;  // the number of triangles alone: a still picture takes its time
    Common common;
};

Result<std::optional<std::array<float, 3>>> read_background(const std::optional<std::string>& text) {
    if (!text) return std::optional<std::array<float, 3>>{};
    const auto numbers = viewer::parse_numbers(*text);
    bool fits = numbers && numbers->size() == 3;
    std::array<float, 3> colour{};
    for (std::size_t i = 0; fits && i < 3; ++i) {
        fits = (*numbers)[i] >= 0 && (*numbers)[i] <= 255;
        colour[i] = static_cast<float>((*numbers)[i] / 255);
    }
    if (!fits)
        return Error{ErrorKind::usage, fmt::format("--background {}: expected R,G,B, each 0 to 255", *text)};
    return std::optional(colour);
}

nlohmann::json to_json(const viewer::ViewState& view, const viewer::PictureRequest& request,
                       const viewer::PictureFigures& figures, const std::string& output) {
    nlohmann::json json{{"picture", output},
                        {"width", request.width},
                        {"height", request.height},
                        {"samples", request.samples},
                        {"lod", to_string(view.method)},
                        {"metric", viewer::metric_name(view.metric)},
                        {"morph", view.morph},
                        {"tau_px", view.tau_px},
                        {"tau_reached_px", figures.tau_reached_px},
                        {"triangles", figures.triangles},
                        {"draw_calls", figures.draw_calls},
                        {"refine_ms", figures.refine_ms},
                        {"frame_ms", figures.frame_ms},
                        {"max_error_px", nullptr},
                        {"rms_error_px", nullptr},
                        {"p99_error_px", nullptr},
                        {"error_posts", nullptr},
                        {"error_pixels", nullptr},
                        {"uncovered_posts", nullptr},
                        {"resident_mib", viewer::resident_mib()},
                        {"ocean", nullptr},
                        {"ocean_vertices", figures.ocean.vertices},
                        {"ocean_triangles", figures.ocean.triangles},
                        {"ocean_draw_calls", figures.ocean.draw_calls},
                        {"ocean_ms", figures.ocean.arrange_ms + figures.ocean.draw_ms},
                        {"overlays", overlays_json(figures.overlays)},
                        {"gl_renderer", figures.gl},
                        {"at", to_string(view)}};
    if (figures.ocean.kind != viewer::OceanKind::off) json["ocean"] = to_string(figures.ocean.kind);
    if (view.method == viewer::Method::full) json["tau_px"] = json["tau_reached_px"] = nullptr;
    if (figures.error) {
        json["max_error_px"] = figures.error->max_px;
        json["rms_error_px"] = figures.error->rms_px;
        json["p99_error_px"] = figures.error->p99_px;
        json["error_posts"] = figures.error->posts;
        json["error_pixels"] = figures.error->pixels;
        json["uncovered_posts"] = figures.error->uncovered_posts;
    }
    return json;
}

void print(const viewer::ViewState& view, const viewer::PictureRequest& request,
           const viewer::PictureFigures& figures, const std::string& output) {
    fmt::print("{}: {} x {} pixels, {} triangles, refined in {:.1f} ms, drawn in {:.1f} ms\n", output,
               request.width, request.height, figures.triangles, figures.refine_ms, figures.frame_ms);
    if (figures.tau_reached_px != view.tau_px)
        fmt::print("tau {:.3g} pixels, to keep to {} triangles\n", figures.tau_reached_px,
                   request.max_triangles.value_or(0));
    if (figures.error) {
        fmt::print("measured error: at most {:.3f} px, RMS {:.3f} px\n", figures.error->max_px,
                   figures.error->rms_px);
    } else if (request.measure_error) {
        fmt::print("measured error: none, for there is no ground in view\n");
    }
    fmt::print("by {}\n--at {}\n", figures.gl, to_string(view));
}

Result<void> draw_frames(const RenderFlags& flags, const lod::Terrain& terrain,
                         const viewer::GroundData& ground, const viewer::EyeHeight& heights,
                         FrameRequest request) {
    auto painter = viewer::OffscreenPainter::create(terrain, ground, heights);
    if (!painter) return painter.error();
    request.picture.timed = false;
    const auto frames = render_frames(request, *painter, progress_bar(flags.common, "drawing"));
    if (!frames) return frames.error();
    if (flags.common.json) {
        fmt::print("{}\n", nlohmann::json({{"pictures", flags.output},
                                           {"frames", *frames},
                                           {"fps", request.fps},
                                           {"width", request.picture.width},
                                           {"height", request.picture.height}})
                               .dump(2));
    } else {
        fmt::print("{}: {} frames, {:.3g} a second\n", flags.output, *frames, request.fps);
    }
    return {};
}

Result<void> run(const RenderFlags& flags) {
    // Everything that the command line got wrong is said before the scene is read.
    auto view = read_view(flags.view, {});
    if (!view) return view.error();
    const auto size = read_size(flags.view, {});
    if (!size) return size.error();
    const auto marks = read_marks(flags.view, *size);
    if (!marks) return marks.error();
    const auto samples = read_samples(flags.view, 4);
    if (!samples) return samples.error();
    const auto budget = read_budget(flags.budget);
    if (!budget) return budget.error();
    const auto background = read_background(flags.background);
    if (!background) return background.error();
    if (auto known = viewer::check_picture_name(flags.output); !known) return known;

    std::optional<viewer::FlightPath> play;
    if (flags.play) {
        if (!(flags.fps >= 0.01 && flags.fps <= 1000)) return Error{ErrorKind::usage, "--fps: 0.01 to 1000"};
        if (flags.measure_error)
            return Error{ErrorKind::usage, "--measure-error is of a single picture, not of a flight's"};
        if (const auto name = frame_name(flags.output, 0); !name) return name.error();
        auto read = viewer::FlightPath::load(*flags.play);
        if (!read) return read.error();
        play = *std::move(read);
        put(*view, play->keys().front());
    }

    const lod::CacheSizes sizes = lod::cache_sizes(lod::find_memory(), flags.view.memory);
    const auto tiles = tile_options(sizes, 0);
    if (!tiles) return tiles.error();

    const auto scene = lod::Scene::open(flags.scene);
    if (!scene) return scene.error();
    auto terrain = lod::Terrain::open(*scene, view->metric, *tiles);
    if (!terrain) return terrain.error();
    if (view->method == viewer::Method::lstr) {
        if (auto done = provide_chunks(*scene, *terrain, flags.common); !done) return done;
    }
    const viewer::EyeHeight heights(scene->geoid());
    if (!play) place_view(*view, flags.view, *scene, *terrain, heights, *size);

    const auto map = read_ground_map(flags.view.ground_map, terrain->frame());
    if (!map) return map.error();
    auto drapes = read_drapes(flags.view, terrain->frame(), *view);
    if (!drapes) return drapes.error();
    const viewer::GroundData ground{.pyramid = terrain->pyramid().get(),
                                    .facts = viewer::ground_facts(scene->info()),
                                    .cache_bytes = sizes.texel_bytes,
                                    .heights = &heights,
                                    .map = *map,
                                    .drapes = *std::move(drapes)};

    const viewer::PictureRequest request{.width = size->width,
                                         .height = size->height,
                                         .samples = *samples,
                                         .background = *background,
                                         .measure_error = flags.measure_error,
                                         .max_triangles = budget->triangles,
                                         .marks = *marks};
    const auto notes = [&](const viewer::ViewState& seen) {
        return viewer::picture_notes(*scene, *terrain, heights, seen, size->width, size->height);
    };
    if (play)
        return draw_frames(flags, *terrain, ground, heights,
                           {flags.output, *play, flags.fps, *view, request, notes});
    const auto finished = viewer::draw_picture(*terrain, ground, heights, *view, request);
    if (!finished) return finished.error();
    if (auto done = viewer::write_picture(finished->picture, flags.output, notes(*view)); !done) return done;
    if (flags.common.json) {
        fmt::print("{}\n", to_json(*view, request, finished->figures, flags.output).dump(2));
    } else {
        print(*view, request, finished->figures, flags.output);
    }
    return {};
}

}  // namespace

void add_render(CLI::App& program, Action& action) {
    auto flags = std::make_shared<RenderFlags>();
    CLI::App* command = program.add_subcommand("render", "Draw a picture of a scene; needs no display");
    command->footer(
        "Example:\n  relevo render colorado.relevo -o blanca.png --eye 37.45,-105.75,3200 --heading 55 "
        "--pitch -3");
    command->add_option("SCENE", flags->scene, "A scene made by relevo ingest")->required();
    command->add_option("-o,--output", flags->output, "The picture: .png, .jpg or .tif")
        ->required()
        ->type_name("PICTURE");
    add_view_flags(*command, flags->view);
    add_drape_flags(*command, flags->view);
    add_max_triangles_flag(*command, flags->budget);
    command
        ->add_option("--play", flags->play,
                     "Draw the frames of a flight; the picture's name then has a %05d for their numbers")
        ->type_name("FLIGHT");
    command->add_option("--fps", flags->fps, "Frames a second of the flight")->capture_default_str();
    command
        ->add_option("--background", flags->background,
                     "A flat colour instead of sky and haze, 0 to 255 each")
        ->type_name("R,G,B");
    command->add_flag("--measure-error", flags->measure_error,
                      "Measure the picture's error against the full data, by brute force");
    add_common(*command, flags->common);
    command->callback([flags, &action] { action = [flags] { return run(*flags); }; });
}

}  // namespace relevo::app
