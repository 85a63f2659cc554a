// Refinement of a real scene along a flight: the reference's textbook recursion and the shipped one in the
// same run.
//
//   refine_bench SCENE [--benchmark_... options]

#include <cstdio>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "lod/mesh_heights.hpp"
#include "lod/soar/refiner.hpp"
#include "lod/textbook/textbook.hpp"
#include "tests/bench/flight.hpp"

namespace {

using namespace relevo;

/// An iteration is the whole flight, so that all methods see the same frames.
void set_counters(benchmark::State& state, std::size_t frames, std::size_t triangles, std::size_t vertices) {
    using benchmark::Counter;
    const auto count = static_cast<double>(triangles);
    state.counters["vertices/tri"] = static_cast<double>(vertices) / count;
    state.counters["triangles"] =
        count / static_cast<double>(state.iterations()) / static_cast<double>(frames);
    state.counters["Mtri/s"] = Counter(count * 1e-6, Counter::kIsRate);
    state.counters["s/frame"] =
        Counter(static_cast<double>(frames), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void shipped(benchmark::State& state, const lod::Terrain& terrain, const std::vector<lod::Camera>& cameras,
             lod::RefineOptions options) {
    lod::Refiner refiner(terrain);
    for (const lod::Camera& camera : cameras) {
        if (!refiner.refine_whole(lod::View(camera), options))
            return state.SkipWithError("tiles are missing");
    }
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    for (auto _ : state) {
        for (const lod::Camera& camera : cameras) {
            const lod::Mesh& mesh = refiner.refine(lod::View(camera), options);
            triangles += mesh.triangles();
            vertices += mesh.vertices.size();
        }
    }
    set_counters(state, cameras.size(), triangles, vertices);
}

/// The same cameras in the textbook's flat world: x east, y south, z up.
void textbook(benchmark::State& state, lod::Textbook& mesh, const lod::Scene& scene,
              const std::vector<lod::Camera>& cameras, double tau) {
    const geo::GridFrame& frame = scene.info().frame;
    const auto spacing = frame.spacing({0.5 * frame.columns, 0.5 * frame.rows});
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    const auto refine = [&](const lod::Camera& camera) {
        const lod::View view(camera);
        const geo::GridPosition place = frame.grid_position({camera.eye.lat, camera.eye.lon});
        const glm::dvec3 eye(place.column * spacing.column_m, place.row * spacing.row_m, camera.eye.h.m);
        const geo::EnuFrame local(camera.eye);
        std::array<glm::dvec3, 4> planes;
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec3& plane = view.side_planes()[i];
            planes[i] = {glm::dot(plane, local.east()), -glm::dot(plane, local.north()),
                         glm::dot(plane, local.up())};
        }
        return mesh.refine(eye, planes, view.focal_px(), tau).size();
    };
    std::size_t triangles_a_flight = 0;
    for (const lod::Camera& camera : cameras) {
        refine(camera);
        triangles_a_flight += mesh.triangles();
    }
    for (auto _ : state) {
        for (const lod::Camera& camera : cameras) vertices += refine(camera);
        triangles += triangles_a_flight;
    }
    set_counters(state, cameras.size(), triangles, vertices);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (argc != 2) {
        fmt::print(stderr, "usage: refine_bench SCENE [--benchmark_... options]\n");
        return 2;
    }
    const auto scene = lod::Scene::open(argv[1]);
    if (!scene) {
        fmt::print(stderr, "{}\n", scene.error().message);
        return 3;
    }
    const lod::TileStoreOptions all{.memory_bytes = std::size_t{4} << 30, .fade_s = 0};
    const auto bounded = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, all);
    const auto incremental = lod::Terrain::open(*scene, lod::ErrorMetric::incremental, all);
    const auto heights = scene->read_all_heights();
    if (!bounded || !incremental || !heights) {
        fmt::print(stderr, "{}: cannot be read\n", argv[1]);
        return 4;
    }
    const geo::GridFrame& frame = scene->info().frame;
    const auto spacing = frame.spacing({0.5 * frame.columns, 0.5 * frame.rows});
    lod::Textbook yardstick(lod::mesh_heights(frame, *heights), spacing.column_m, spacing.row_m);
    const std::vector<lod::Camera> cameras = bench::flight(*scene, 100);

    for (const double tau : {0.25, 1.0}) {
        const auto name = [tau](const char* what) { return fmt::format("{}/tau:{}", what, tau); };
        const auto add = [&](const char* what, auto run) {
            return benchmark::RegisterBenchmark(name(what).c_str(), run)
                ->Unit(benchmark::kMillisecond)
                ->Repetitions(5)
                ->ReportAggregatesOnly();
        };
        const auto add_shipped = [&](const char* what, const lod::Terrain& terrain, bool morph,
                                     bool parallel) {
            const lod::RefineOptions options{.tau_px = tau, .morph = morph, .parallel = parallel};
            return add(what,
                       [&, options](benchmark::State& state) { shipped(state, terrain, cameras, options); });
        };
        add("textbook",
            [&, tau](benchmark::State& state) { textbook(state, yardstick, *scene, cameras, tau); });
        add_shipped("soar-incremental", *incremental, false, false);
        add_shipped("soar-bounded", *bounded, false, false);
        add_shipped("soar-bounded-morph", *bounded, true, false);
        add_shipped("soar-bounded, all cores", *bounded, false, true)->UseRealTime();
        add_shipped("soar-bounded-morph, all cores", *bounded, true, true)->UseRealTime();
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
