// The chunked quadtree over a real scene: what the filter, the generation and the frames cost, with errors
// measured by the oracle, beside SOAR's meshes of the same views.
//
//   chunk_trial SCENE filter           both tests of the filter against plain loops (the reference's table 1)
//   chunk_trial SCENE build            time, memory and triangles by level (its table 2)
//   chunk_trial SCENE views [N]        N sample views (20) at 0.5, 1 and 2 pixels, without and with the morph

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "lod/lstr/chunk_mesher.hpp"
#include "lod/lstr/removable_posts.hpp"
#include "lod/oracle.hpp"
#include "lod/pyramid/scene_pyramid.hpp"
#include "lod/sample_views.hpp"
#include "lod/soar/refiner.hpp"

namespace {

using namespace relevo;

double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

double peak_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// As the reference writes it down, a post at a time.
std::vector<bool> plain_filter(const lod::Raster<float>& heights, float margin, lod::RemovalTest test) {
    std::vector<bool> found(heights.samples().size());
    for (int row = 1; row + 1 < heights.rows(); ++row) {
        for (int column = 1; column + 1 < heights.columns(); ++column) {
            const auto H = [&](int x, int y) { return heights.at(column + x, row + y); };
            const float A = H(-1, -1), B = H(0, -1), C = H(1, -1), D = H(-1, 0), E = H(0, 0), F = H(1, 0),
                        G = H(-1, 1), I = H(1, 1), S = H(0, 1);
            const bool goes =
                test == lod::RemovalTest::pairs
                    ? std::abs(0.5F * (A + I) - E) <= margin && std::abs(0.5F * (B + S) - E) <= margin &&
                          std::abs(0.5F * (C + G) - E) <= margin && std::abs(0.5F * (F + D) - E) <= margin
                    : std::abs(0.125F * (((A + I) + (B + S)) + ((C + G) + (D + F))) - E) <= margin;
            found[static_cast<std::size_t>(row) * static_cast<std::size_t>(heights.columns()) +
                  static_cast<std::size_t>(column)] = goes;
        }
    }
    return found;
}

int run_filter(const lod::Scene& scene) {
    const auto heights = scene.read_all_heights();
    if (!heights) return 1;
    const float margin = lod::margin_of_range(*heights, 0.01);
    fmt::print(
        "{} x {} posts, margin {:.3f} m\n| test | s, plain loop | s | ratio | may go | same bits "
        "|\n|---|---:|---:|---:|---:|---|\n",
        heights->columns(), heights->rows(), margin);
    for (const auto test : {lod::RemovalTest::pairs, lod::RemovalTest::mean}) {
        std::vector<double> plain_s, ours_s;
        bool same = true;
        std::uint64_t going = 0;
        for (int run = 0; run < 5; ++run) {
            std::vector<bool> plain;
            plain_s.push_back(seconds_of([&] { plain = plain_filter(*heights, margin, test); }));
            ours_s.push_back(seconds_of([&] {
                const lod::PostSet ours = lod::removable_posts(*heights, margin, test);
                if (run > 0) return;
                for (int row = 0; row < heights->rows(); ++row) {
                    for (int column = 0; column < heights->columns(); ++column) {
                        const bool goes = ours.contains({column, row});
                        going += goes ? 1 : 0;
                        same = same && goes == plain[static_cast<std::size_t>(row) *
                                                         static_cast<std::size_t>(heights->columns()) +
                                                     static_cast<std::size_t>(column)];
                    }
                }
            }));
        }
        ours_s.erase(ours_s.begin());  // it compared
        fmt::print("| {} | {:.3f} | {:.3f} | {:.1f} | {:.1f} % | {} |\n",
                   test == lod::RemovalTest::pairs ? "pairs" : "mean", median(plain_s), median(ours_s),
                   median(plain_s) / median(ours_s),
                   100.0 * static_cast<double>(going) / static_cast<double>(heights->samples().size()),
                   same ? "yes" : "NO");
    }
    return 0;
}

lod::ChunkErrors errors_for(const lod::Terrain& terrain) {
    const auto& frame = terrain.frame();
    const auto spacing = frame.spacing({0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)});
    return lod::ChunkErrors::for_spacing(std::min(spacing.column_m, spacing.row_m));
}

int run_build(const lod::Terrain& terrain) {
    struct Level {
        int nodes = 0;
        std::uint64_t vertices = 0, triangles = 0;
        std::vector<double> errors_m;
    };
    std::vector<Level> levels(20);
    const lod::ChunkErrors errors = errors_for(terrain);
    const double before_mib = peak_mib();
    const double s = seconds_of([&] {
        const auto count = [&](const lod::ChunkMesh& mesh) -> lod::ChunkBuilder::Writing {
            return [&, id = mesh.id, vertices = mesh.vertices.size(), triangles = mesh.triangles.size(),
                    error_m = mesh.error_m]() -> Result<void> {
                Level& level = levels[static_cast<std::size_t>(id.level)];
                ++level.nodes;
                level.vertices += vertices;
                level.triangles += triangles;
                level.errors_m.push_back(error_m);
                return {};
            };
        };
        const auto done = lod::ChunkBuilder(terrain, {errors}).build(count);
        if (!done) fmt::print("{}\n", done.error().message);
    });
    fmt::print(
        "{:.1f} s, peak {:.0f} MiB (before: {:.0f})\n| level | nodes | vertices | triangles | may be off m | "
        "is off m: median | most |\n|---:|---:|---:|---:|---:|---:|---:|\n",
        s, peak_mib(), before_mib);
    for (std::size_t k = 1; k < levels.size() && levels[k].nodes > 0; ++k) {
        fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", k, levels[k].nodes,
                   levels[k].vertices, levels[k].triangles, errors.of_level(static_cast<int>(k)),
                   median(levels[k].errors_m),
                   *std::max_element(levels[k].errors_m.begin(), levels[k].errors_m.end()));
    }
    return 0;
}

int run_views(const lod::Terrain& terrain, int count) {
    const auto chunks = lod::MemoryChunks::build(terrain, errors_for(terrain));
    if (!chunks) return 1;
    lod::ChunkMesher lstr(terrain, *chunks);
    lod::Refiner soar(terrain);
    fmt::print(
        "| tau | morph | lstr: triangles | nodes | ms | error / tau | soar: triangles | ms | error / tau "
        "|\n|---:|---|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const double tau : {0.5, 1.0, 2.0}) {
        for (const bool morph : {false, true}) {
            std::vector<double> triangles[2], ms[2], nodes;
            double worst[2]{};
            for (const lod::Camera& camera : lod::sample_views(terrain, count, 3, 1280, 720)) {
                const lod::View view(camera);
                const lod::RefineOptions options{.tau_px = tau, .morph = morph};
                for (int method = 0; method < 2; ++method) {
                    const auto make = [&] {
                        return method == 0 ? lstr.whole_mesh(view, options)
                                           : soar.refine_whole(view, options);
                    };
                    if (!make()) return 1;
                    const lod::Mesh* mesh = nullptr;
                    ms[method].push_back(1e3 * seconds_of([&] { mesh = *make(); }));
                    triangles[method].push_back(static_cast<double>(mesh->triangles()));
                    if (method == 0) nodes.push_back(lstr.figures().drawn_nodes);
                    if (const auto error = lod::measure_error(terrain, view, *mesh))
                        worst[method] = std::max(worst[method], error->max_px / tau);
                }
            }
            fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.2f} | {:.0f} | {:.1f} | {:.2f} |\n", tau,
                       morph ? "on" : "off", median(triangles[0]), median(nodes), median(ms[0]), worst[0],
                       median(triangles[1]), median(ms[1]), worst[1]);
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 2 ? argv[2] : "";
    if (what != "filter" && what != "build" && what != "views") {
        fmt::print(stderr, "usage: chunk_trial SCENE filter|build|views [N]\n");
        return 2;
    }
    const auto scene = lod::Scene::open(argv[1]);
    if (!scene) {
        fmt::print(stderr, "{}\n", scene.error().message);
        return 3;
    }
    if (what == "filter") return run_filter(*scene);
    const auto terrain = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, {});
    if (!terrain) {
        fmt::print(stderr, "{}\n", terrain.error().message);
        return 3;
    }
    if (what == "build") return run_build(*terrain);
    return run_views(*terrain, argc > 3 ? std::max(std::atoi(argv[3]), 1) : 20);
}
