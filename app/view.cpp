#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/ground_map_flag.hpp"
#include "app/view_flags.hpp"
#include "viewer/flight.hpp"

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
    return {{"frames", figures.frames},
            {"frame_ms_median", figures.frame_ms_median},
            {"frame_ms_p99", figures.frame_ms_p99},
            {"refine_ms_median", figures.refine_ms_median},
            {"triangles", figures.triangles},
            {"tau_reached_px", figures.tau_reached_px},
            {"frames_within_budget",
             figures.frames_within_budget ? nlohmann::json(*figures.frames_within_budget) : nullptr},
            {"draw_calls", figures.draw_calls},
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

Result<void> run(const WindowFlags& flags) {
    viewer::ViewState moving;
    moving.morph = true;  // a picture that moves should not jump
    auto view = read_view(flags.view, moving);
    if (!view) return view.error();
    const auto size = read_size(flags.view, {});
    if (!size) return size.error();
    int samples = 0;
    if (flags.view.samples) {
        const auto asked = read_samples(flags.view, 0);
        if (!asked) return asked.error();
        samples = *asked;
    }
    if (auto fine = check(flags); !fine) return fine;
    const auto budget = read_budget(flags.budget);
    if (!budget) return budget.error();
    std::optional<viewer::FlightPath> play;
    if (flags.play) {
        auto read = viewer::FlightPath::load(*flags.play);
        if (!read) return read.error();
        play = std::move(*read);
        put(*view, play->keys().front());
    }

    const lod::CacheSizes sizes = lod::cache_sizes(lod::find_machine(flags.scene), flags.view.memory);
    const auto tiles = tile_options(sizes, 0.5);
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
    const viewer::GroundData ground{
        .pyramid = terrain->pyramid().get(),
        .facts = viewer::ground_facts(scene->info()),
        .cache_bytes = sizes.texel_bytes,
        .heights = &heights,
        .map = *map,
        .report = [](const std::string& line) { fmt::print(stderr, "relevo view: {}\n", line); }};

    viewer::FlightOptions options{.width = size->width,
                                  .height = size->height,
                                  .samples = samples,
                                  .forward_m_s = flags.fly_m_s,
                                  .frames = flags.frames,
                                  .play = std::move(play),
                                  .record = flags.record.value_or(""),
                                  .chunks = {.store = {.memory_bytes = tiles->memory_bytes,
                                                       .threads = tiles->threads,
                                                       .read_delay_s = tiles->read_delay_s},
                                             .selection = {.swap_factor = sizes.swap_factor}},
                                  .budget = *budget,
                                  .ui_scale = flags.ui_scale,
                                  .screenshot_folder = flags.screenshot_dir};
    // With --json, stdout is one object; what happens on the way goes to stderr.
    std::FILE* events = flags.common.json ? stderr : stdout;
    options.say = [events](const std::string& line) {
        fmt::print(events, "{}\n", line);
        std::fflush(events);
    };
    if (flags.record) {
        std::signal(SIGINT, [](int) { interrupted = 1; });
        options.must_close = [] { return interrupted != 0; };
    }
    const auto figures = viewer::fly(*scene, *terrain, ground, heights, *view, options);
    if (!figures) return figures.error();
    if (flags.common.json) fmt::print("{}\n", to_json(*figures).dump(2));
    return {};
}

}  // namespace

void add_view(CLI::App& program, Action& action) {
    auto flags = std::make_shared<WindowFlags>();
    CLI::App* command = program.add_subcommand("view", "Fly over a scene and measure in it, in a window");
    command->footer(
        "Example:\n  relevo view colorado.relevo --eye 37.45,-105.75,3200 --heading 55 --fly 200\nF1 lists "
        "the keys.");
    command->add_option("SCENE", flags->scene, "A scene made by relevo ingest")->required();
    add_view_flags(*command, flags->view);
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
    command->add_option("--screenshot-dir", flags->screenshot_dir, "Where P and F12 write [.]")
        ->type_name("DIR");
    add_common(*command, flags->common);
    command->callback([flags, &action] { action = [flags] { return run(*flags); }; });
}

}  // namespace relevo::app
