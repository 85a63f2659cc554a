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
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "lod/lstr/chunk_making.hpp"
#include "lod/lstr/chunk_mesher.hpp"
#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "viewer/bench/machine.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/renderer.hpp"

namespace {

using namespace relevo;
using Clock = std::chrono::steady_clock;

template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return *std::move(result);
}
void must(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().message);
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

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

enum class Method { lstr, soar };

/// How a row of a table is drawn.
struct Setting {
    Method method = Method::lstr;
    double tau_px = 1;
    lod::SelectionOptions selection = {.fade_s = 0};
    bool joined = false;  // nodes are not kept in graphics memory, but made one mesh each frame
    double view_distance_m = std::numeric_limits<double>::infinity();

    lod::RefineOptions refine() const { return {.tau_px = tau_px, .view_distance_m = view_distance_m}; }
};

struct Row {
    double frames_s = 0;
    double triangles = 0;  // the mean over the frames, as all below
    double resident_mib = 0;
    double draw_calls = 0;
    double made_ms = 0;  // from a view to its shape handed over
    double nodes_drawn = 0;
    double nodes_in_memory = 0;
    double nodes_sent_kib = 0;
    double largest_error_px = 0;
};

/// A scene with what draws it.
class Stage {
  public:
    Stage(const std::string& folder, int width, int height, const lod::ChunkStoreOptions& store = {})
        : scene_(must(lod::Scene::open(folder))),
          terrain_(must(lod::Terrain::open(scene_, lod::ErrorMetric::bounded, {.fade_s = 0}))),
          width_(width),
          height_(height),
          store_(store),
          target_(must(viewer::RenderTarget::create(width, height, 1))),
          refiner_(terrain_) {
        must(lod::provide_chunks(scene_, terrain_));
        renderer_ = std::make_unique<viewer::Renderer>(must(viewer::Renderer::create(
            terrain_, {.pyramid = terrain_.pyramid().get(), .facts = viewer::ground_facts(scene_.info())})));
    }

    const lod::Terrain& terrain() const { return terrain_; }
    double spacing_m() const {
        const geo::GridFrame& frame = terrain_.frame();
        return frame.spacing({0.5 * frame.columns, 0.5 * frame.rows}).row_m;
    }

    /// Metres to the north of the scene's middle.
    lod::Camera camera(double north_m, double H_m, double pitch) const {
        const geo::GridFrame& frame = terrain_.frame();
        const geo::GridPosition place{0.5 * (frame.columns - 1),
                                      0.5 * (frame.rows - 1) - north_m / spacing_m()};
        const geo::LatLon at = frame.lat_lon(place);
        lod::Camera camera;
        camera.eye = {at.lat, at.lon, {terrain_.undulations().at(place) + H_m}};
        camera.pitch = geo::Degrees{pitch};
        camera.width = width_;
        camera.height = height_;
        return camera;
    }
    /// Of the reference's path, at twice the highest post.
    lod::View view_at(double part) const {
        const double side_m = terrain_.frame().rows * spacing_m();
        return lod::View(camera(side_m * (-0.45 + 0.6 * part), 7500, -20));
    }

    /// Draws a view of what is in memory.
    viewer::DrawnGround draw(const lod::View& view, const Setting& setting, Row* row = nullptr) {
        const auto start = Clock::now();
        const viewer::DrawnGround ground = ground_of(view, setting);
        renderer_->upload(ground);
        const double made_ms = 1e3 * seconds_since(start);
        const auto drawn = must(renderer_->draw(view, settings_, target_));
        viewer::gl_finish();
        if (row != nullptr) {
            row->made_ms += made_ms;
            row->triangles += static_cast<double>(viewer::triangles(ground));
            row->draw_calls += drawn.draw_calls;
            const auto figures = chunks(setting).figures();
            row->nodes_drawn += figures.drawn_nodes;
            row->nodes_in_memory += static_cast<double>(figures.store.resident_nodes);
            row->nodes_sent_kib += static_cast<double>(renderer_->node_figures().sent_bytes) / 1024;
        }
        return ground;
    }

    /// Waits until all that the path wants is there: what is measured then is drawing.
    void load_path(const Setting& setting) {
        constexpr int kStops = 30;
        for (int k = 0; k <= kStops; ++k) {
            const lod::View view = view_at(static_cast<double>(k) / kStops);
            settle(view, setting);
            must(renderer_->complete(view, settings_, {0, 0, width_, height_}));
        }
    }

    /// Flies the path once.
    Row fly(const Setting& setting, int frames) {
        Row row;
        draw(view_at(0), setting);
        const auto start = Clock::now();
        for (int k = 0; k < frames; ++k) draw(view_at(static_cast<double>(k) / (frames - 1)), setting, &row);
        row.frames_s = frames / seconds_since(start);
        for (double* sum : {&row.triangles, &row.draw_calls, &row.made_ms, &row.nodes_drawn,
                            &row.nodes_in_memory, &row.nodes_sent_kib})
            *sum /= frames;
        row.resident_mib = viewer::resident_mib();
        return row;
    }

    /// The largest error that the oracle finds at places of the path, pixels.
    double largest_error_px(const Setting& setting) {
        constexpr int kPlaces = 6;
        double worst_px = 0;
        for (int k = 0; k < kPlaces; ++k) {
            const lod::View view = view_at(static_cast<double>(k) / (kPlaces - 1));
            settle(view, setting);
            const auto error = lod::measure_error(terrain_, view, mesh_of(view, ground_of(view, setting)));
            if (error) worst_px = std::max(worst_px, error->max_px);
        }
        return worst_px;
    }

    lod::ChunkMesher& chunks(const Setting& setting) {
        if (!chunks_)
            chunks_ = std::make_unique<lod::ChunkMesher>(terrain_, *terrain_.chunks(),
                                                         lod::ChunkOptions{.store = store_, .selection = {}});
        chunks_->selection() = setting.selection;
        return *chunks_;
    }

    /// \pre  made last
    const lod::Mesh& mesh_of(const lod::View& view, const viewer::DrawnGround& ground) {
        const auto* nodes = std::get_if<lod::ChunkPicture>(&ground);
        return nodes != nullptr ? chunks_->assemble(view, *nodes) : std::get<0>(ground).get();
    }

    /// Pixels that show the background, which is red as no ground is.
    int pixels_without_ground(const lod::View& view, const viewer::DrawnGround& ground) {
        viewer::DrawSettings settings = settings_;
        settings.background = {{1, 0, 0}};
        settings.layer = viewer::Layer::plain;
        renderer_->upload(ground);
        must(renderer_->draw(view, settings, target_));
        viewer::Picture picture(width_, height_);
        target_.read_into(picture, 0, 0);
        int found = 0;
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const std::uint8_t* pixel = picture.pixel(x, y);
                found += pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 0 ? 1 : 0;
            }
        }
        return found;
    }

  private:
    viewer::DrawnGround ground_of(const lod::View& view, const Setting& setting) {
        if (setting.method == Method::lstr) {
            const lod::ChunkPicture nodes = must(chunks(setting).picture(view, setting.refine()));
            if (setting.joined) return chunks_->assemble(view, nodes);
            return nodes;
        }
        terrain_.tiles().start_frame();
        return refiner_.refine(view, setting.refine());
    }
    void settle(const lod::View& view, const Setting& setting) {
        if (setting.method == Method::soar) {
            must(refiner_.refine_whole(view, setting.refine()));
            return;
        }
        lod::ChunkMesher& mesher = chunks(setting);
        must(mesher.picture(view, setting.refine()));
        while (mesher.figures().store.pending_groups > 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            must(mesher.picture(view, setting.refine()));
        }
    }

    lod::Scene scene_;
    lod::Terrain terrain_;
    int width_;
    int height_;
    lod::ChunkStoreOptions store_;
    viewer::RenderTarget target_;
    lod::Refiner refiner_;
    std::unique_ptr<lod::ChunkMesher> chunks_;
    std::unique_ptr<viewer::Renderer> renderer_;
    viewer::DrawSettings settings_;
};

constexpr const char* kHead =
    "| {} | method | frames/s | triangles | memory MiB | draw calls | ms to draw calls | nodes drawn | nodes "
    "in "
    "memory | KiB of nodes sent | largest error px "
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
