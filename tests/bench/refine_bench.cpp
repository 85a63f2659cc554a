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
#include "tests/bench/flight.hpp"
#include "tests/bench/textbook.hpp"

namespace {

using namespace relevo;

void set_counters(benchmark::State& state, std::size_t triangles, std::size_t vertices) {
    state.counters["vertices/tri"] = static_cast<double>(vertices) / static_cast<double>(triangles);
    state.counters["triangles"] =
        benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kAvgIterations);
    state.counters["Mtri/s"] =
        benchmark::Counter(static_cast<double>(triangles) * 1e-6, benchmark::Counter::kIsRate);
}

void shipped(benchmark::State& state, const lod::Terrain& terrain, const std::vector<lod::Camera>& cameras,
             double tau, bool morph) {
    lod::Refiner refiner(terrain);
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    std::size_t k = 0;
    for (auto _ : state) {
        const lod::View view(cameras[k++ % cameras.size()]);
        const lod::Mesh& mesh = **refiner.refine_whole(view, {.tau_px = tau, .morph = morph});
        triangles += mesh.triangles();
        vertices += mesh.vertices.size();
    }
    set_counters(state, triangles, vertices);
}

/// The same cameras in the textbook's flat world: x east, y south, z up.
void textbook(benchmark::State& state, bench::Textbook& mesh, const lod::Scene& scene,
              const std::vector<lod::Camera>& cameras, double tau) {
    const geo::GridFrame& frame = scene.info().frame;
    const auto spacing = frame.spacing({0.5 * frame.columns, 0.5 * frame.rows});
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    std::size_t k = 0;
    for (auto _ : state) {
        const lod::Camera& camera = cameras[k++ % cameras.size()];
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
        vertices += mesh.refine(eye, planes, view.focal_px(), tau).size();
        state.PauseTiming();
        triangles += mesh.triangles();
        state.ResumeTiming();
    }
    set_counters(state, triangles, vertices);
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
    const auto bounded = lod::Terrain::load(*scene, lod::ErrorMetric::bounded);
    const auto incremental = lod::Terrain::load(*scene, lod::ErrorMetric::incremental);
    const auto heights = scene->read_all_heights();
    if (!bounded || !incremental || !heights) {
        fmt::print(stderr, "{}: cannot be read\n", argv[1]);
        return 4;
    }
    const geo::GridFrame& frame = scene->info().frame;
    const auto spacing = frame.spacing({0.5 * frame.columns, 0.5 * frame.rows});
    bench::Textbook yardstick(lod::mesh_heights(frame, *heights), spacing.column_m, spacing.row_m);
    const std::vector<lod::Camera> cameras = bench::flight(*scene, 100);

    for (const double tau : {0.25, 1.0}) {
        const auto name = [tau](const char* what) { return fmt::format("{}/tau:{}", what, tau); };
        const auto add = [&](const char* what, auto run) {
            benchmark::RegisterBenchmark(name(what).c_str(), run)
                ->Unit(benchmark::kMillisecond)
                ->Repetitions(5);
        };
        add("textbook",
            [&, tau](benchmark::State& state) { textbook(state, yardstick, *scene, cameras, tau); });
        add("soar-incremental",
            [&, tau](benchmark::State& state) { shipped(state, *incremental, cameras, tau, false); });
        add("soar-bounded",
            [&, tau](benchmark::State& state) { shipped(state, *bounded, cameras, tau, false); });
        add("soar-bounded-morph",
            [&, tau](benchmark::State& state) { shipped(state, *bounded, cameras, tau, true); });
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
