// Is tau a bound? Random views of a scene, ordinary and not (grazing, inside spheres, fov 1 and 150, a tiny
// picture, exaggerated), random taus, with and without the morph: the largest measured error as a part of
// tau. Then the price of it: triangles of both metrics at the same *measured* error.
//
//   error_survey SCENE [VIEWS]

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/sample_views.hpp"
#include "lod/soar/refiner.hpp"

namespace {

using namespace relevo;

struct Judged {
    double max_px = 0;
    double triangles = 0;
};

/// The largest measured error over views, and the mean number of triangles.
Result<Judged> judge(const lod::Terrain& terrain, lod::Refiner& refiner,
                     const std::vector<lod::Camera>& cameras, const lod::RefineOptions& options) {
    Judged judged;
    for (const lod::Camera& camera : cameras) {
        const lod::View view(camera);
        const auto mesh = refiner.refine_whole(view, options);
        if (!mesh) return mesh.error();
        judged.triangles += static_cast<double>((*mesh)->triangles()) / static_cast<double>(cameras.size());
        const auto error = lod::measure_error(terrain, view, **mesh, options.exaggeration);
        if (error) judged.max_px = std::max(judged.max_px, error->max_px);
    }
    return judged;
}

Result<bool> survey(const lod::Terrain& terrain, int views) {
    lod::Refiner refiner(terrain);
    std::mt19937_64 random(11);
    auto cameras = lod::sample_views(terrain, views, 12345, 640, 360);
    double worst = 0;
    int with_ground = 0;
    int faults = 0;
    for (std::size_t k = 0; k < cameras.size(); ++k) {
        lod::Camera& camera = cameras[k];
        constexpr double fovs[] = {60, 60, 1, 150, 20, 100};
        constexpr double taus[] = {0.5, 1, 2, 4, 16};
        constexpr double exaggerations[] = {1, 1, 5, 0.5};
        camera.fov = geo::Degrees{fovs[random() % 6]};
        lod::RefineOptions options{.tau_px = taus[random() % 5], .morph = random() % 2 == 0};
        options.exaggeration = exaggerations[random() % 4];
        if (options.tau_px == 16 && random() % 2 == 0) {
            camera.width = 40;
            camera.height = 30;
        }
        const lod::View view(camera);
        const auto mesh = refiner.refine_whole(view, options);
        if (!mesh) return mesh.error();
        faults += lod::count_t_vertices(**mesh) + lod::count_torn_posts(**mesh);
        const auto error = lod::measure_error(terrain, view, **mesh, options.exaggeration);
        if (!error) continue;
        ++with_ground;
        faults += static_cast<int>(error->uncovered_posts);
        worst = std::max(worst, error->max_px / options.tau_px);
        if (error->max_px > options.tau_px) {
            fmt::print(
                "view {}: {:.3f} px at tau {}: lat {} lon {} h {} heading {} pitch {} fov {} exaggeration {} "
                "morph {}\n",
                k, error->max_px, options.tau_px, camera.eye.lat.value, camera.eye.lon.value, camera.eye.h.m,
                camera.heading.value, camera.pitch.value, camera.fov.value, options.exaggeration,
                options.morph);
        }
    }
    fmt::print("{} views, {} with ground: largest measured error {:.3f} tau; holes and cracks: {}\n", views,
               with_ground, worst, faults);
    std::fflush(stdout);
    return worst <= 1 && faults == 0;
}

Result<void> compare(const lod::Terrain& bounded, const lod::Terrain& incremental) {
    lod::Refiner of_bounded(bounded);
    lod::Refiner of_incremental(incremental);
    const auto cameras = lod::sample_views(bounded, 12, 99, 640, 360);
    fmt::print("measured px | triangles: bounded | incremental | ratio\n");
    for (const double tau : {0.5, 1.0, 2.0, 4.0}) {
        const auto ours = judge(bounded, of_bounded, cameras, {.tau_px = tau, .morph = false});
        if (!ours) return ours.error();
        // The coarsest tau whose measured error is not larger.
        double fine = tau / 8;
        double coarse = 2 * tau;
        Judged theirs;
        for (int i = 0; i < 10; ++i) {
            const double middle = std::sqrt(fine * coarse);
            const auto tried =
                judge(incremental, of_incremental, cameras, {.tau_px = middle, .morph = false});
            if (!tried) return tried.error();
            if (tried->max_px <= ours->max_px) {
                fine = middle;
                theirs = *tried;
            } else {
                coarse = middle;
            }
        }
        fmt::print("{:.3f} | {:.0f} | {:.0f} (tau {:.3f}) | {:.2f}\n", ours->max_px, ours->triangles,
                   theirs.triangles, fine, theirs.triangles / std::max(ours->triangles, 1.0));
        std::fflush(stdout);
    }
    return {};
}

Result<bool> run(const char* path, int views) {
    const auto scene = lod::Scene::open(path);
    if (!scene) return scene.error();
    const lod::TileStoreOptions options{.fade_s = 0};
    const auto bounded = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, options);
    if (!bounded) return bounded.error();
    const auto incremental = lod::Terrain::open(*scene, lod::ErrorMetric::incremental, options);
    if (!incremental) return incremental.error();
    const auto kept = survey(*bounded, views);
    if (!kept) return kept;
    if (auto done = compare(*bounded, *incremental); !done) return done.error();
    return kept;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: error_survey SCENE [VIEWS]\n");
        return 2;
    }
    const auto kept = run(argv[1], argc > 2 ? std::max(std::atoi(argv[2]), 1) : 200);
    if (!kept) {
        fmt::print(stderr, "{}\n", kept.error().message);
        return 1;
    }
    return *kept ? 0 : 1;
}
