#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "output/measurement_file.hpp"
#include "output/viewshed_file.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/drape_flags.hpp"
#include "app/ground_map_flag.hpp"
#include "app/layer_files.hpp"
#include "app/overlay_json.hpp"
#include "app/quick_import.hpp"
#include "app/view_flags.hpp"
#include "viewer/flight/flight.hpp"

namespace relevo::app {

namespace {

struct WindowFlags {
    std::string scene;
    double fly_m_s = 0;
    std::uint64_t frames = 0;
    double ui_scale = 0;
    std::string screenshot_dir = ".";
    std::optional<std::string> record, play;
    BudgetFlags budget;
    ViewFlags view;
    Common common;
};

nlohmann::json to_json(const viewer::FlightFigures& figures) {
    nlohmann::json gl_objects = nlohmann::json::object();
    for (int i = 0; i < viewer::kGlKinds; ++i)
        gl_objects[to_string(static_cast<viewer::GlKind>(i))] =
            figures.gl_objects[static_cast<std::size_t>(i)];
    return {{"frames", figures.frames},
            {"frame_ms_median", figures.frame_ms_median},
            {"frame_ms_p99", figures.frame_ms_p99},
            {"refine_ms_median", figures.refine_ms_median},
            {"triangles", figures.triangles},
            {"tau_reached_px", figures.tau_reached_px},
            {"frames_within_budget",
             figures.frames_within_budget ? nlohmann::json(*figures.frames_within_budget) : nullptr},
            {"draw_calls", figures.draw_calls},
            {"overlays", overlays_json(figures.overlays)},
            {"gl_objects", std::move(gl_objects)},
            {"width", figures.width},
            {"height", figures.height},
            {"samples", figures.samples},
            {"gl_renderer", figures.gl},
            {"at", to_string(figures.view)}};
}

Result<void> check(const WindowFlags& flags) {
    const auto wrong = [](std::string message) { return Error{ErrorKind::usage, std::move(message)}; };
    if (!(flags.fly_m_s >= 0 && flags.fly_m_s <= 1e6)) return wrong("--fly: 0 to 1000000 metres a second");
    if (!(flags.ui_scale == 0 || (flags.ui_scale >= 0.5 && flags.ui_scale <= 4)))
        return wrong("--ui-scale: 0.5 to 4");
    std::error_code failed;
    if (!std::filesystem::is_directory(flags.screenshot_dir, failed)) {
        return wrong(fmt::format("--screenshot-dir {}: there is no such folder", flags.screenshot_dir));
    }
    if (flags.record) {
        if (std::filesystem::exists(*flags.record, failed))
            return wrong(fmt::format("--record {}: it exists already", *flags.record));
        const auto folder = std::filesystem::absolute(*flags.record, failed).parent_path();
        if (!std::filesystem::is_directory(folder, failed))
            return wrong(fmt::format("--record {}: there is no such folder", *flags.record));
    }
    return {};
}

/// Ctrl-C while recording closes the window, so that what was flown is kept.
volatile std::sig_atomic_t interrupted = 0;

viewer::MeasurementFiles measurement_files() {
    const auto save = [](const std::vector<viewer::Shape>& shapes,
                         const std::vector<const viewer::ShapeResult*>& results,
                         const std::filesystem::path& file) {
        std::vector<output::MeasurementRecord> records;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            output::MeasurementRecord& record = records.emplace_back();
            record.measurement = shapes[i].measurement;
            if (results[i] == nullptr) continue;
            record.H_m = results[i]->H_m;
            record.results = results[i]->json;
        }
        return output::save_measurements(file, records, false);
    };
    const auto save_viewshed = [](const lod::SceneInfo& info, const lod::Viewshed& shed,
                                  const std::filesystem::path& file) {
        return output::write_viewshed(file, info, shed, false);
    };
    return {output::is_measurement_file, output::load_measurements, save, save_viewshed};
}

/// What the flags say of the view and of the flight, for whichever scene.
struct Request {
    viewer::ViewState view;
    viewer::FlightOptions flight;
    PictureSize size;
};

Result<Request> read_request(const WindowFlags& flags) {
    Request request;
    request.view.morph = true;  // a picture that moves should not jump
    auto view = read_view(flags.view, request.view);
    if (!view) return view.error();
    request.view = *std::move(view);
    const auto size = read_size(flags.view, {});
    if (!size) return size.error();
    request.size = *size;
    const auto marks = read_marks(flags.view, {});
    if (!marks) return marks.error();
    request.flight.picture_marks = *marks;
    if (flags.view.samples) {
        const auto samples = read_samples(flags.view, 0);
        if (!samples) return samples.error();
        request.flight.samples = *samples;
    }
    if (auto fine = check(flags); !fine) return fine.error();
    const auto budget = read_budget(flags.budget);
    if (!budget) return budget.error();
    request.flight.budget = *budget;
    if (flags.play) {
        auto play = viewer::FlightPath::load(*flags.play);
        if (!play) return play.error();
        put(request.view, play->keys().front());
        request.flight.play = *std::move(play);
    }
    request.flight.forward_m_s = flags.fly_m_s;
    request.flight.frames = flags.frames;
    request.flight.record = flags.record.value_or("");
    request.flight.output_folder = flags.screenshot_dir;
    request.flight.files = measurement_files();
    request.flight.layers = layer_files();
    return request;
}

/// One scene, until the window is closed or another one is to be opened.
Result<viewer::FlightFigures> fly_over(viewer::Desk& desk, const lod::Scene& scene, const WindowFlags& flags,
                                       Request request) {
    const lod::CacheSizes sizes = lod::cache_sizes(lod::find_machine(scene.path()), flags.view.memory);
    const auto tiles = tile_options(sizes, 0.5);
    if (!tiles) return tiles.error();
    auto terrain = lod::Terrain::open(scene, request.view.metric, *tiles);
    if (!terrain) return terrain.error();
    if (request.view.method == viewer::Method::lstr) {
        if (auto done = provide_chunks(scene, *terrain, flags.common); !done) return done.error();
    }
    const viewer::EyeHeight heights(scene.geoid());
    if (!request.flight.play) place_view(request.view, flags.view, scene, *terrain, heights, request.size);

    const auto map = read_ground_map(flags.view.ground_map, terrain->frame());
    if (!map) return map.error();
    auto drapes = read_drapes(flags.view, terrain->frame(), request.view);
    if (!drapes) return drapes.error();
    const viewer::GroundData ground{
        .pyramid = terrain->pyramid().get(),
        .facts = viewer::ground_facts(scene.info()),
        .cache_bytes = sizes.texel_bytes,
        .heights = &heights,
        .map = *map,
        .drapes = *std::move(drapes),
        .report = [](const std::string& line) { fmt::print(stderr, "relevo view: {}\n", line); }};
    request.flight.chunks = {.store = {.memory_bytes = tiles->memory_bytes,
                                       .threads = tiles->threads,
                                       .read_delay_s = tiles->read_delay_s},
                             .selection = {.swap_factor = sizes.swap_factor}};
    return viewer::fly(desk, scene, *terrain, ground, heights, request.view, request.flight);
}

/// The scene of the command line is open before the window is: what is wrong with it ends the program.
Result<std::optional<lod::Scene>> first_scene(const WindowFlags& flags) {
    if (flags.scene.empty()) return std::optional<lod::Scene>();
    const auto place = viewer::scene_at(flags.scene);
    std::error_code failed;
    if (!place && std::filesystem::is_regular_file(flags.scene, failed)) {
        if (auto fine = check_importable(flags.scene); !fine) return fine.error();
        return std::optional<lod::Scene>();
    }
    auto scene = lod::Scene::open(place.value_or(flags.scene));
    if (!scene) return scene.error();
    return std::optional(*std::move(scene));
}

Result<void> run(const WindowFlags& flags) {
    auto request = read_request(flags);
    if (!request) return request.error();
    auto scene = first_scene(flags);
    if (!scene) return scene.error();
    auto desk = viewer::Desk::create({.width = request->size.width,
                                      .height = request->size.height,
                                      .ui_scale = flags.ui_scale,
                                      .settings = viewer::settings_file(),
                                      .make_scene = quick_import,
                                      .uses_of = layer_files().uses_of});
    if (!desk) return desk.error();
    if (!flags.scene.empty() && !*scene) desk->open(flags.scene);

    // With --json, stdout is one object; what happens on the way goes to stderr.
    std::FILE* events = flags.common.json ? stderr : stdout;
    request->flight.say = [events](const std::string& line) {
        fmt::print(events, "{}\n", line);
        std::fflush(events);
    };
    if (flags.record) {
        std::signal(SIGINT, [](int) { interrupted = 1; });
        request->flight.must_close = [] { return interrupted != 0; };
    }
    std::optional<viewer::FlightFigures> figures;
    while (!desk->window().should_close()) {
        if (!*scene) {
            auto place = desk->take_next();
            if (!place) {
                const auto chosen = viewer::choose_scene(*desk);
                if (!chosen) return chosen.error();
                place = *chosen;
            }
            if (!place) break;  // closed
            auto opened = lod::Scene::open(*place);
            if (!opened) {
                desk->tell(opened.error().message);
                continue;
            }
            scene->emplace(*std::move(opened));
        }
        std::error_code failed;
        desk->settings().remember(
            std::filesystem::absolute((*scene)->path(), failed).lexically_normal().string());
        const auto flown = fly_over(*desk, **scene, flags, *request);
        if (!flown) return flown.error();
        figures = *flown;
        scene->reset();
        request->flight.record.clear();
        request->flight.play.reset();
    }
    desk->save();
    if (flags.common.json)
        fmt::print("{}\n", figures ? to_json(*figures).dump(2) : nlohmann::json::object().dump());
    return {};
}

}  // namespace

void add_view(CLI::App& program, Action& action) {
    auto flags = std::make_shared<WindowFlags>();
    CLI::App* command = program.add_subcommand("view", "Fly over a scene and measure in it, in a window");
    command->footer(
        "Example:\n  relevo view colorado.relevo --eye 37.45,-105.75,3200 --heading 55 --fly 200\nF1 lists "
        "the keys.");
    command->add_option("SCENE", flags->scene,
                        "A scene, or an elevation file, which is imported first; without it one is chosen "
                        "in the window");
    add_view_flags(*command, flags->view);
    add_drape_flags(*command, flags->view);
    command->add_option("--fly", flags->fly_m_s, "Fly ahead by itself, until a key is pressed")
        ->type_name("M_PER_S");
    command->add_option("--play", flags->play, "Replay a flight, until a key is pressed")
        ->type_name("FLIGHT");
    command->add_option("--record", flags->record, "Write what is flown as a flight, when the window closes")
        ->type_name("FLIGHT");
    add_budget_flags(*command, flags->budget);
    command->add_option("--frames", flags->frames, "Close after so many frames")->type_name("N");
    command->add_option("--ui-scale", flags->ui_scale, "Size of letters and marks [the screen's]")
        ->type_name("X");
    command
        ->add_option("--screenshot-dir", flags->screenshot_dir,
                     "Where pictures, flights and measurements are written [.]")
        ->type_name("DIR");
    add_common(*command, flags->common);
    command->callback([flags, &action] { action = [flags] { return run(*flags); }; });
}

}  // namespace relevo::app
