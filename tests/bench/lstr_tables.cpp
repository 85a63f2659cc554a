// The reference's tables of its runtime run again, for LSTR and for SOAR, with the errors that it never gave:
// 300 frames straight from the south to the north over the middle of a scene, 7500 m up, drawn off-screen
// in the tints, morphing. Figures are medians of interleaved runs.
//
//   lstr_tables sort SCENE           drawn from front to back and not (its table 3), as nodes or as one mesh
//   lstr_tables sizes SCENE...       by the size of the map (its table 4)
//   lstr_tables distance SCENE       by the view distance in posts (its table 5)
//   lstr_tables swap SCENE           by the swap sphere's radius in posts (its table 6)
//   lstr_tables floor SCENE...       which picture and tau hold 30 frames a second
//   lstr_tables flight SCENE         2000 frames with too small a swap sphere and slow reads: times, cracks
// Each may end in --size WxH (1280x720), --tau PX (1), --runs N (3), --frames N (300).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lod/mesh_checks.hpp"
#include "tests/bench/lstr_stage.hpp"
#include "viewer/bench/machine.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_context_egl.hpp"

namespace {

using namespace relevo;
using namespace relevo::lstr_tables;

double quantile(std::vector<double> values, double part) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

struct Options {
    int width = 1280;
    int height = 720;
    double tau_px = 1;
    int runs = 3;
    int frames = 300;
};

constexpr const char* kHead =
    "| {} | method | frames/s | triangles | memory MiB | draw calls | ms to draw calls | nodes drawn | "
    "nodes in memory | KiB of nodes sent | largest error px "
    "|\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";

void print(const std::string& what, Method method, const std::vector<Row>& runs) {
    std::vector<double> rates;
    for (const Row& run : runs) rates.push_back(run.frames_s);
    const Row& row = runs.front();
    const bool lstr = method == Method::lstr;
    const auto of_nodes = [&](double figure) { return lstr ? fmt::format("{:.0f}", figure) : ""; };
    fmt::print("| {} | {} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.2f} | {} | {} | {} | {:.2f} |\n", what,
               lstr ? "lstr" : "soar", quantile(rates, 0.5), row.triangles, row.resident_mib, row.draw_calls,
               row.made_ms, of_nodes(row.nodes_drawn), of_nodes(row.nodes_in_memory),
               of_nodes(row.nodes_sent_kib), row.largest_error_px);
    std::fflush(stdout);
}

struct Named {
    std::string name;
    Setting setting;
};

/// All settings of one scene in turn, so often as there are runs.
void run_table(Stage& stage, const std::vector<Named>& settings, const Options& options) {
    std::vector<std::vector<Row>> rows(settings.size());
    for (int run = 0; run < options.runs; ++run) {
        for (std::size_t i = 0; i < settings.size(); ++i) {
            stage.load_path(settings[i].setting);
            rows[i].push_back(stage.fly(settings[i].setting, options.frames));
        }
    }
    for (std::size_t i = 0; i < settings.size(); ++i) {
        rows[i].front().largest_error_px = stage.largest_error_px(settings[i].setting);
        print(settings[i].name, settings[i].setting.method, rows[i]);
    }
}

void sort_table(const std::string& scene, const Options& options) {
    Stage stage(scene, options.width, options.height);
    const Setting usual{.tau_px = options.tau_px};
    Setting unsorted = usual;
    unsorted.selection.front_to_back = false;
    Setting joined = usual;
    joined.joined = true;
    const std::vector<Named> settings{{"front to back", usual},
                                      {"as the tree lists them", unsorted},
                                      {"front to back, made one mesh each frame", joined}};
    fmt::print(kHead, "order");
    run_table(stage, settings, options);
}

void sizes_table(const std::vector<std::string>& scenes, const Options& options) {
    fmt::print(kHead, "posts");
    for (const std::string& scene : scenes) {
        // Each method with a process's memory of its own would be best; the mesher that flies first is the
        // one whose memory is small.
        for (const Method method : {Method::lstr, Method::soar}) {
            Stage stage(scene, options.width, options.height);
            const std::string posts = fmt::format("{}", stage.terrain().frame().columns);
            run_table(stage, {{posts, {.method = method, .tau_px = options.tau_px}}}, options);
        }
    }
}

void distance_table(const std::string& scene, const Options& options) {
    Stage stage(scene, options.width, options.height);
    std::vector<Named> settings;
    for (const int posts : {500, 1500}) {
        for (const Method method : {Method::lstr, Method::soar}) {
            settings.push_back(
                {fmt::format("{}", posts),
                 {.method = method, .tau_px = options.tau_px, .view_distance_m = posts * stage.spacing_m()}});
        }
    }
    fmt::print(kHead, "view distance, posts");
    run_table(stage, settings, options);
}

void swap_table(const std::string& scene, const Options& options) {
    fmt::print(kHead, "swap radius, posts");
    for (const int posts : {1150, 2230, 3450}) {
        Stage stage(scene, options.width, options.height, {.memory_bytes = std::uint64_t{2} << 30});
        Setting setting{.tau_px = options.tau_px};
        setting.selection.swap_radius_m = posts * stage.spacing_m();
        run_table(stage, {{fmt::format("{}", posts), setting}}, options);
    }
}

void floor_table(const std::vector<std::string>& scenes, const Options& options) {
    fmt::print(
        "| posts | picture | method | frames/s at tau 0.5 | 1 | 2 | 4 "
        "|\n|---|---|---|---:|---:|---:|---:|\n");
    struct Size {
        int width, height;
    };
    for (const std::string& scene : scenes) {
        for (const Size size : {Size{640, 360}, Size{1280, 720}, Size{1920, 1080}}) {
            Stage stage(scene, size.width, size.height);
            for (const Method method : {Method::lstr, Method::soar}) {
                fmt::print("| {} | {}x{} | {} |", stage.terrain().frame().columns, size.width, size.height,
                           method == Method::lstr ? "lstr" : "soar");
                for (const double tau : {0.5, 1.0, 2.0, 4.0}) {
                    const Setting setting{.method = method, .tau_px = tau};
                    stage.load_path(setting);
                    fmt::print(" {:.1f} |", stage.fly(setting, options.frames / 4).frames_s);
                    std::fflush(stdout);
                }
                fmt::print("\n");
            }
        }
    }
}

/// Winds through the middle of the scene, so that every pixel shows ground.
void flight(const std::string& scene, const Options& options) {
    constexpr std::uint64_t kMemory = std::uint64_t{8} << 20;
    constexpr double kReadDelayS = 0.02;
    constexpr double kSwapRadiusM = 4000;
    constexpr int kFrames = 2000;
    Stage stage(scene, options.width, options.height,
                {.memory_bytes = kMemory, .threads = 1, .read_delay_s = kReadDelayS});
    Setting setting{.tau_px = options.tau_px};
    setting.selection.fade_s = 0.3;
    setting.selection.swap_radius_m = kSwapRadiusM;
    std::vector<double> frame_ms;
    int cracked_meshes = 0, torn_meshes = 0, pending_frames = 0;
    long holes = 0;
    std::uint64_t most_bytes = 0;
    for (int k = 0; k < kFrames; ++k) {
        const double part = static_cast<double>(k) / (kFrames - 1);
        lod::Camera camera = stage.camera(3000 * std::sin(6.3 * part), 4700 + 700 * std::sin(25 * part), -65);
        camera.heading = geo::Degrees{720 * part};
        const lod::View view(camera);
        const auto start = Clock::now();
        const viewer::DrawnGround ground = stage.draw(view, setting);
        frame_ms.push_back(1e3 * seconds_since(start));
        const lod::Mesh& mesh = stage.mesh_of(view, ground);
        cracked_meshes += lod::count_t_vertices(mesh) > 0 ? 1 : 0;
        torn_meshes += lod::count_torn_posts(mesh) > 0 ? 1 : 0;
        holes += stage.pixels_without_ground(view, ground);
        const auto figures = stage.chunks(setting).figures().store;
        most_bytes = std::max(most_bytes, figures.resident_bytes);
        pending_frames += figures.pending_groups > 0 ? 1 : 0;
    }
    const auto store = stage.chunks(setting).figures().store;
    const double median = quantile(frame_ms, 0.5);
    const double p99 = quantile(frame_ms, 0.99);
    fmt::print(
        "{} frames at {}x{}, tau {}, swap radius {} m, {} ms a read: median {:.2f} ms, p99 {:.2f} ms "
        "({:.2f} "
        "medians), largest {:.2f} ms\nwaiting for nodes in {} frames; {} groups read; at most {:.1f} MiB of "
        "{:.1f}\nmeshes with T-vertices {}, with torn posts {}; pixels without ground {} of {}\n",
        kFrames, options.width, options.height, options.tau_px, kSwapRadiusM, 1e3 * kReadDelayS, median, p99,
        p99 / median, quantile(frame_ms, 1), pending_frames, store.read_groups,
        static_cast<double>(most_bytes) / (1 << 20), static_cast<double>(kMemory) / (1 << 20), cracked_meshes,
        torn_meshes, holes, static_cast<long>(kFrames) * options.width * options.height);
}

int run(const std::vector<std::string>& words) {
    Options options;
    std::vector<std::string> scenes;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word.rfind("--", 0) != 0) {
            scenes.push_back(word);
            continue;
        }
        const std::string value = ++i < words.size() ? words[i] : "";
        if (word == "--size" && std::sscanf(value.c_str(), "%dx%d", &options.width, &options.height) == 2)
            continue;
        const double number = std::atof(value.c_str());
        if (number > 0 && word == "--tau")
            options.tau_px = number;
        else if (number >= 1 && word == "--runs")
            options.runs = static_cast<int>(number);
        else if (number >= 8 && word == "--frames")
            options.frames = static_cast<int>(number);
        else
            return 2;
    }
    if (scenes.empty()) return 2;
    const auto context = must(viewer::OffscreenContext::create());
    const viewer::Machine machine = viewer::describe_machine();
    fmt::print("{} x {}, load {:.1f}; {}; {}x{}, tau {}\n", machine.cores, machine.cpu, machine.load_average,
               viewer::gl_description(), options.width, options.height, options.tau_px);
    if (words[0] == "sort")
        sort_table(scenes[0], options);
    else if (words[0] == "sizes")
        sizes_table(scenes, options);
    else if (words[0] == "distance")
        distance_table(scenes[0], options);
    else if (words[0] == "swap")
        swap_table(scenes[0], options);
    else if (words[0] == "floor")
        floor_table(scenes, options);
    else if (words[0] == "flight")
        flight(scenes[0], options);
    else
        return 2;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int status = argc > 1 ? run({argv + 1, argv + argc}) : 2;
        if (status == 2)
            fmt::print(
                stderr,
                "usage: lstr_tables sort|sizes|distance|swap|floor|flight SCENE... [--size WxH] [--tau "
                "PX] [--runs N] [--frames N]\n");
        return status;
    } catch (const std::exception& failure) {
        fmt::print(stderr, "{}\n", failure.what());
        return 3;
    }
}
