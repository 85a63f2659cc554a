// How paging holds up: a flight far too fast for slow reads into a small memory, drawn off-screen in real
// time at a frame budget; then the eye stands still until all is there. Prints figures; the exit status says
// whether a mesh was cracked, or the last one is farther off than tau.
//
//   paging_trial SCENE [TILE_MIB DELAY_MS BUDGET_MS METRES_ABOVE SPEED_M_S SECONDS]

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"

namespace {

using namespace relevo;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Trial {
    double tile_mib = 32;
    double delay_ms = 50;
    double budget_ms = 50;
    double metres_above = 300;
    double speed_m_s = 1200;
    double seconds = 20;
};

/// From the south to the north over the middle of the scene, and back.
lod::Camera camera_at(const lod::Terrain& terrain, const Trial& trial, double way_m) {
    const geo::GridFrame& frame = terrain.frame();
    const double length_m = 0.8 * frame.rows * frame.spacing({0.5 * frame.columns, 0.5 * frame.rows}).row_m;
    const double turns = way_m / length_m;
    const double part = turns - 2 * std::floor(turns / 2);
    const bool northward = part < 1;
    const double along = northward ? part : 2 - part;
    const geo::GridPosition place{0.5 * frame.columns, (0.9 - 0.8 * along) * frame.rows};
    lod::TruePosts::Reader posts(terrain.posts());
    const float H = posts.H(static_cast<int>(place.column), static_cast<int>(place.row));
    const geo::LatLon at = frame.lat_lon(place);
    lod::Camera camera;
    camera.eye = {
        at.lat, at.lon, {static_cast<double>(H) + terrain.undulations().at(place) + trial.metres_above}};
    camera.heading = geo::Degrees{northward ? 0.0 : 180.0};
    camera.pitch = geo::Degrees{-12};
    return camera;
}

Result<bool> run(const char* path, const Trial& trial) {
    const auto scene = lod::Scene::open(path);
    if (!scene) return scene.error();
    lod::TileStoreOptions options;
    options.memory_bytes = static_cast<std::size_t>(trial.tile_mib * 1024 * 1024);
    options.threads = 8;
    options.read_delay_s = trial.delay_ms / 1000;
    const auto terrain = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, options);
    if (!terrain) return terrain.error();
    const auto context = viewer::OffscreenContext::create();
    if (!context) return context.error();
    const viewer::GroundData ground{.pyramid = terrain->pyramid().get(),
                                    .facts = viewer::ground_facts(scene->info()),
                                    .cache_bytes = std::size_t{64} << 20};
    auto renderer = viewer::Renderer::create(*terrain, ground);
    if (!renderer) return renderer.error();
    const auto target = viewer::RenderTarget::create(1280, 720, 1);
    if (!target) return target.error();

    viewer::Mesher mesher(*terrain);
    viewer::FrameBudget budget({.frame_ms = trial.budget_ms, .triangles = {}}, 1);
    viewer::ViewState state;
    state.morph = true;
    const auto draw = [&](const lod::View& view, double& refine_ms) -> Result<const lod::Mesh*> {
        const auto start = Clock::now();
        const lod::Mesh& mesh = mesher.mesh(view, mesher.ground(view, state, budget));
        state.tau_px = budget.tau_px();
        refine_ms = 1000 * seconds_since(start);
        renderer->upload(mesh);
        const auto drawn = renderer->draw(view, {}, *target);
        if (!drawn) return drawn.error();
        viewer::gl_finish();
        budget.add({1000 * seconds_since(start), mesh.triangles(), terrain->tiles().figures().memory_load});
        return &mesh;
    };

    std::vector<double> frame_ms, refine_ms, taus;
    std::size_t behind = 0;
    std::size_t most_bytes = 0;
    int cracks = 0;
    double paused_s = 0;
    const auto start = Clock::now();
    while (seconds_since(start) - paused_s < trial.seconds) {
        const lod::View view(camera_at(*terrain, trial, trial.speed_m_s * (seconds_since(start) - paused_s)));
        const auto frame = Clock::now();
        double refine = 0;
        const auto mesh = draw(view, refine);
        if (!mesh) return mesh.error();
        frame_ms.push_back(1000 * seconds_since(frame));
        refine_ms.push_back(refine);
        taus.push_back(state.tau_px);
        const auto figures = terrain->tiles().figures();
        behind += figures.pending_tiles > 0;
        most_bytes = std::max(most_bytes, figures.resident_bytes);
        if (frame_ms.size() % 10 == 0) {
            const auto pause = Clock::now();
            cracks += lod::count_t_vertices(**mesh) + lod::count_torn_posts(**mesh);
            paused_s += seconds_since(pause);
        }
    }
    fmt::print(
        "frames {}, behind in {}, frame ms median {:.1f} p99 {:.1f} (budget {:.0f}), refine ms median {:.2f} "
        "p99 {:.2f}, tau median {:.2f} p99 {:.2f} px, tiles at most {:.1f} MiB, blocks read {}, cracks {}\n",
        frame_ms.size(), behind, quantile(frame_ms, 0.5), quantile(frame_ms, 0.99), trial.budget_ms,
        quantile(refine_ms, 0.5), quantile(refine_ms, 0.99), quantile(taus, 0.5), quantile(taus, 0.99),
        static_cast<double>(most_bytes) / 1048576, terrain->tiles().figures().read_blocks, cracks);

    const lod::View still(camera_at(*terrain, trial, trial.speed_m_s * trial.seconds));
    const auto rest = Clock::now();
    struct Still {
        double passed_s;
        double tau_px;
        lod::Mesh mesh;
    };
    std::vector<Still> drawn;
    for (bool whole = false; !whole && seconds_since(rest) < 4;) {
        double refine = 0;
        const auto mesh = draw(still, refine);
        if (!mesh) return mesh.error();
        terrain->tiles().start_frame();
        whole = terrain->tiles().figures().pending_tiles == 0 && !terrain->tiles().is_fading();
        // Some are kept: measuring takes seconds.
        if (drawn.empty() || whole || seconds_since(rest) - drawn.back().passed_s > 0.25)
            drawn.push_back({seconds_since(rest), state.tau_px, **mesh});
    }
    // Errors are measured afterwards, so that nobody waits for them: the last first, until one is too large.
    const auto error_px = [&](const Still& frame) {
        const auto error = lod::measure_error(*terrain, still, frame.mesh);
        return error ? error->max_px : 0;
    };
    const double last_px = error_px(drawn.back());
    auto from = std::prev(drawn.end());
    while (from != drawn.begin() && error_px(*std::prev(from)) <= std::prev(from)->tau_px) --from;
    fmt::print(
        "still: error under tau from {:.2f} s on, all there after {:.2f} s, tau {:.2f} px, measured error "
        "{:.2f} px, starved: {}\n",
        from->passed_s, drawn.back().passed_s, drawn.back().tau_px, last_px,
        terrain->tiles().figures().starved());
    return cracks == 0 && last_px <= drawn.back().tau_px;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(
            stderr,
            "usage: paging_trial SCENE [TILE_MIB DELAY_MS BUDGET_MS METRES_ABOVE SPEED_M_S SECONDS]\n");
        return 2;
    }
    Trial trial;
    double* const values[] = {&trial.tile_mib,     &trial.delay_ms,  &trial.budget_ms,
                              &trial.metres_above, &trial.speed_m_s, &trial.seconds};
    for (int i = 2; i < argc && i < 8; ++i) *values[i - 2] = std::atof(argv[i]);
    const auto whole = run(argv[1], trial);
    if (!whole) {
        fmt::print(stderr, "{}\n", whole.error().message);
        return 1;
    }
    return *whole ? 0 : 1;
}
