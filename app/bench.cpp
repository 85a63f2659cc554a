#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/command.hpp"
#include "app/view_flags.hpp"
#include "viewer/bench/bench_report.hpp"
#include "viewer/bench/ocean_bench.hpp"
#include "viewer/bench/result_folder.hpp"
#include "viewer/flight/default_flight.hpp"
#include "viewer/numbers.hpp"

namespace relevo::app {

namespace {

struct BenchFlags {
    std::string scene;
    std::string output;
    std::optional<std::string> flight, taus, methods, ocean_at, ocean_rows;
    std::optional<int> frames, runs, error_every;
    bool quick = false;
    bool overwrite = false;
    ViewFlags view;
    BudgetFlags budget;
    Common common;
};

Error usage(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

Result<std::vector<double>> read_taus(const std::string& text) {
    auto taus = viewer::parse_numbers(text);
    if (!taus || std::any_of(taus->begin(), taus->end(), [](double tau) { return !(tau > 0 && tau <= 1e6); }))
        return usage(fmt::format("--taus {}: expected numbers of pixels above 0, between commas", text));
    std::sort(taus->begin(), taus->end());
    taus->erase(std::unique(taus->begin(), taus->end()), taus->end());
    return *taus;
}

Result<std::vector<viewer::BenchMethod>> read_methods(const std::string& text) {
    std::vector<viewer::BenchMethod> methods;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const auto method = viewer::parse_bench_method(std::string_view(text).substr(at, end - at));
        if (!method) return usage("--methods: " + method.error().message);
        if (std::count(methods.begin(), methods.end(), *method) == 0) methods.push_back(*method);
        at = end + 1;
    }
    return methods;
}

/// A few frames of a few taus: does it work, and about how fast?
void make_quick(viewer::BenchOptions& options) {
    options.taus = {0.5, 2, 8};
    options.frames = 8;
    options.runs = 1;
    options.error_every = 4;
    options.budget_s = 1;
}

Result<void> keep_count(const char* flag, const std::optional<int>& given, int least, int most, int& place) {
    if (!given) return {};
    if (*given < least || *given > most)
        return usage(fmt::format("{} {}: {} to {}", flag, *given, least, most));
    place = *given;
    return {};
}

Result<viewer::BenchOptions> read_options(const BenchFlags& flags) {
    viewer::BenchOptions options;
    if (flags.quick) make_quick(options);
    auto look = read_view(flags.view, {});
    if (!look) return look.error();
    options.look = *look;
    const auto size = read_size(flags.view, {});
    if (!size) return size.error();
    options.width = size->width;
    options.height = size->height;
    if (size->width > 4096 || size->height > 4096) return usage("--size: at most 4096x4096 for bench");
    const auto samples = read_samples(flags.view, 1);
    if (!samples) return samples.error();
    options.samples = *samples;
    if (flags.view.morph) options.morphs = {look->morph};
    if (flags.view.tau) options.taus = {look->tau_px};
    if (flags.taus) {
        const auto taus = read_taus(*flags.taus);
        if (!taus) return taus.error();
        options.taus = *taus;
    }
    if (flags.methods) {
        const auto methods = read_methods(*flags.methods);
        if (!methods) return methods.error();
        options.methods = *methods;
    }
    // The same on every machine, busy or not: figures are compared.
    const auto memory = flags.view.memory.value_or(std::uint64_t{1} << 30);
    const lod::CacheSizes sizes = lod::cache_sizes({.cores = 4}, memory);
    const auto tiles = tile_options(sizes, 0.5);
    if (!tiles) return tiles.error();
    options.tiles = *tiles;
    options.ground_bytes = sizes.texel_bytes;
    const auto budget = read_budget(flags.budget);
    if (!budget) return budget.error();
    options.budget = *budget;
    if (auto done = keep_count("--frames", flags.frames, 1, 100000, options.frames); !done)
        return done.error();
    if (auto done = keep_count("--runs", flags.runs, 1, 1000, options.runs); !done) return done.error();
    if (auto done = keep_count("--error-every", flags.error_every, 0, 100000, options.error_every); !done)
        return done.error();
    return options;
}

/// \param bench  what is measured of the ground
Result<viewer::OceanBenchOptions> read_ocean(const BenchFlags& flags, const viewer::BenchOptions& bench) {
    viewer::OceanBenchOptions ocean{.width = bench.width,
                                    .height = bench.height,
                                    .look = bench.look.ocean,
                                    .place = {},
                                    .tiles = bench.tiles};
    if (flags.quick) {
        ocean.errors_px = {1};
        ocean.frames = 1;
    }
    if (flags.ocean_rows == "all")
        take_all_rows(ocean);
    else if (flags.ocean_rows && flags.ocean_rows != "usual")
        return usage(fmt::format("--ocean-rows {}: usual or all", *flags.ocean_rows));
    if (flags.ocean_at) {
        const auto numbers = viewer::parse_numbers(*flags.ocean_at);
        if (!numbers || numbers->size() != 2 || std::abs((*numbers)[0]) > 90 || std::abs((*numbers)[1]) > 360)
            return usage(fmt::format("--ocean-at {}: expected LAT,LON in degrees", *flags.ocean_at));
        ocean.place = {geo::Degrees{(*numbers)[0]}, geo::Degrees{(*numbers)[1]}};
    }
    return ocean;
}

Result<void> run(const BenchFlags& flags, const std::string& command) {
    // Everything that the command line got wrong is said before the scene is read.
    const auto options = read_options(flags);
    if (!options) return options.error();
    const auto ocean = read_ocean(flags, *options);
    if (!ocean) return ocean.error();
    if (auto fine = viewer::check_result_folder(flags.output, flags.overwrite); !fine) return fine;
    std::optional<viewer::FlightPath> flight;
    if (flags.flight) {
        auto read = viewer::FlightPath::load(*flags.flight);
        if (!read) return read.error();
        flight = std::move(*read);
    }
    const auto scene = lod::Scene::open(flags.scene);
    if (!scene) return scene.error();
    const viewer::EyeHeight heights(scene->geoid());
    if (!flight) {
        lod::HeightSampler sampler(*scene);
        auto made = viewer::default_flight(sampler);
        if (!made) return made.error();
        flight = std::move(*made);
    }

    auto result = viewer::run_bench(*scene, heights, *flight, *options, progress_bar(flags.common, "flying"));
    if (!result) return result.error();
    auto sea =
        viewer::run_ocean_bench(*scene, heights, *ocean, progress_bar(flags.common, "measuring the sea"));
    if (!sea) return sea.error();
    result->ocean = std::move(*sea);
    const auto rows = viewer::summarize(*result);
    const viewer::BenchSubject subject{*scene,   *flight, flags.flight.value_or("made from the scene"),
                                       *options, command, RELEVO_VERSION};
    auto json = viewer::bench_json(subject, *result, rows);
    // Nobody is to find half a result: neither where writing fails, nor where Ctrl-C comes now.
    std::signal(SIGINT, SIG_IGN);
    std::map<std::string, std::string> files{{"bench.json", json.dump(2) + "\n"},
                                             {"bench.csv", viewer::bench_csv(rows)},
                                             {"frames.csv", viewer::frames_csv(*result)},
                                             {"bench.html", bench_page(subject, *result, rows)},
                                             {"flight.txt", flight->to_text()}};
    if (!result->ocean.rows.empty()) files["ocean.csv"] = viewer::ocean_csv(result->ocean);
    if (auto done = viewer::write_result_folder(flags.output, files); !done) return done;
    if (flags.common.json) {
        json["folder"] = flags.output;
        fmt::print("{}\n", json.dump(2));
    } else {
        fmt::print("{}{}/bench.html has plots and all figures\n", viewer::bench_text(*result, rows),
                   flags.output);
    }
    return {};
}

/// The command line, for the report.
std::string command_line(const CLI::App& program, const CLI::App& command) {
    std::string line = program.get_name();
    line += " " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        if (!option->get_positional()) line += " " + option->get_name();
        if (option->get_items_expected_max() == 0) continue;
        for (const std::string& value : option->results()) line += " " + value;
    }
    return line;
}

}  // namespace

void add_bench(CLI::App& program, Action& action) {
    auto flags = std::make_shared<BenchFlags>();
    CLI::App* command = program.add_subcommand("bench", "Measure speed against error along a flight");
    command->footer(
        "Example:\n  relevo bench colorado.relevo -o colorado-bench\ncolorado-bench/bench.html has the "
        "plots.");
    command->add_option("SCENE", flags->scene, "A scene made by relevo ingest")->required();
    const auto add = [&](const char* name, auto& place, const char* value, const char* what) {
        return command->add_option(name, place, what)->type_name(value);
    };
    add("-o,--output", flags->output, "DIR", "Where the results go: a new or an empty folder")->required();
    command->add_flag("--overwrite", flags->overwrite, "Write into a folder that is not empty");
    add("--flight", flags->flight, "FLIGHT", "A flight to fly [one made from the scene]");
    add("--methods", flags->methods, "LIST", "Of soar-bounded, soar-incremental, lstr, textbook, full [all]");
    add("--taus", flags->taus, "LIST", "Pixels [0.25,0.5,1,2,4,8,16]");
    add("--frames", flags->frames, "N", "Of each method and tau, at equal times along the flight [20]");
    add("--runs", flags->runs, "N", "How often everything is flown, in turns [3]");
    add("--error-every", flags->error_every, "N", "Measure the error of each N-th frame; 0: of none [5]");
    command->add_flag("--quick", flags->quick, "One run of 8 frames of 3 taus");
    add("--ocean-at", flags->ocean_at, "LAT,LON", "Where the sea is measured [the widest water]");
    add("--ocean-rows", flags->ocean_rows, "usual|all",
        "Heights of the eye, directions and sizes of the sea's meshes [usual]");
    add_picture_flags(*command, flags->view);
    add_budget_flags(*command, flags->budget);
    add_common(*command, flags->common);
    command->callback([flags, &action, &program, command] {
        action = [flags, line = command_line(program, *command)] { return run(*flags, line); };
    });
}

}  // namespace relevo::app
