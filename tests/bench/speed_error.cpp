// Speed against error on a real scene, as CSV: for each metric, morph and tau the medians over a flight of
// views of triangles, refinement and whole frame (refine, upload, draw, to the last pixel), and the measured
// error over all.
//
//   speed_error SCENE [VIEWS] > table.csv

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "tests/bench/flight.hpp"
#include "viewer/camera.hpp"
#include "viewer/offscreen.hpp"

namespace {

using namespace relevo;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Row {
    std::vector<double> triangles;
    std::vector<double> refine_ms;
    std::vector<double> frame_ms;
    double max_px = 0;
    double sum_of_squares = 0;
    int measured = 0;
};

Result<void> run_row(const lod::Terrain& terrain, const viewer::GroundData& ground,
                     const viewer::EyeHeight& heights, viewer::ViewState state,
                     const std::vector<lod::Camera>& cameras) {
    Row row;
    for (const lod::Camera& camera : cameras) {
        viewer::set_eye(state, heights, camera.eye);
        state.heading = camera.heading;
        state.pitch = camera.pitch;
        viewer::PictureRequest request;
        request.width = camera.width;
        request.height = camera.height;
        request.samples = 1;
        request.measure_error = true;
        const auto picture = viewer::draw_picture(terrain, ground, heights, state, request);
        if (!picture) return picture.error();
        const viewer::PictureFigures& figures = picture->figures;
        row.triangles.push_back(static_cast<double>(figures.triangles));
        row.refine_ms.push_back(figures.refine_ms);
        row.frame_ms.push_back(figures.frame_ms);
        if (!figures.error) continue;
        row.max_px = std::max(row.max_px, figures.error->max_px);
        row.sum_of_squares += figures.error->rms_px * figures.error->rms_px;
        ++row.measured;
    }
    fmt::print("{},{},{},{:.0f},{:.3f},{:.2f},{:.4f},{:.4f}\n", viewer::metric_name(state.metric),
               state.morph ? "on" : "off", state.tau_px, median(row.triangles), median(row.refine_ms),
               median(row.frame_ms), row.max_px, std::sqrt(row.sum_of_squares / std::max(row.measured, 1)));
    std::fflush(stdout);
    return {};
}

Result<void> run(const char* path, int views) {
    const auto scene = lod::Scene::open(path);
    if (!scene) return scene.error();
    const auto heights = viewer::EyeHeight::create(scene->info().vertical.datum);
    if (!heights) return heights.error();
    fmt::print(
        "metric,morph,tau_px,triangles_median,refine_ms_median,frame_ms_median,max_error_px,rms_error_px\n");
    for (const auto metric : {lod::ErrorMetric::bounded, lod::ErrorMetric::incremental}) {
        const auto terrain = lod::Terrain::open(*scene, metric, {.fade_s = 0});
        if (!terrain) return terrain.error();
        const viewer::GroundData ground{.pyramid = terrain->pyramid().get(),
                                        .facts = viewer::ground_facts(scene->info())};
        const auto cameras = bench::flight(*scene, views);
        for (const bool morph : {false, true}) {
            for (double tau = 0.25; tau <= 16; tau *= 2) {
                viewer::ViewState state;
                state.metric = metric;
                state.morph = morph;
                state.tau_px = tau;
                if (auto done = run_row(*terrain, ground, *heights, state, cameras); !done) return done;
            }
        }
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        fmt::print(stderr, "usage: speed_error SCENE [VIEWS]\n");
        return 2;
    }
    const int views = argc == 3 ? std::atoi(argv[2]) : 10;
    if (const auto done = run(argv[1], std::max(views, 1)); !done) {
        fmt::print(stderr, "{}\n", done.error().message);
        return 1;
    }
    return 0;
}
