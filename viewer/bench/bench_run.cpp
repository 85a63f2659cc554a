#include "viewer/bench/bench_run.hpp"

#include <algorithm>
#include <chrono>

#include <malloc.h>

#include "viewer/bench/bench_mesher.hpp"
#include "viewer/camera.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/renderer.hpp"

namespace relevo::viewer {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Frames of `full` that say as much as many: its mesh is the same in each.
constexpr int kFullFrames = 10;

/// One method of one run: flies its rows.
class MethodRun {
  public:
    MethodRun(const lod::Scene& scene, const EyeHeight& heights, const FlightPath& flight,
              const BenchOptions& options, int run, BenchMesher& mesher, Renderer& renderer,
              const RenderTarget& target)
        : scene_(scene),
          heights_(heights),
          flight_(flight),
          options_(options),
          run_(run),
          mesher_(mesher),
          renderer_(renderer),
          target_(target) {}

    Result<void> fly(BenchRow& row) { return row.setting.by_budget ? fly_by_budget(row) : fly_steps(row); }

  private:
    Result<void> fly_steps(BenchRow& row) {
        const double tau = row.setting.tau_px.value_or(0);
        const int frames = row.setting.method == BenchMethod::full ? std::min(options_.frames, kFullFrames)
                                                                   : options_.frames;
        // Once for nothing: buffers grow, programs are compiled.
        if (auto warm = draw(row.setting, flight_.begin_s(), tau, {}); !warm) return warm.error();
        const int every = options_.error_every;
        for (int k = 0; k < frames; ++k) {
            const double part = frames > 1 ? static_cast<double>(k) / (frames - 1) : 0.5;
            auto frame = draw(row.setting, flight_.begin_s() + part * flight_.duration_s(), tau,
                              {.error = every > 0 && run_ == 0 && k % every == every / 2,
                               .jump = run_ == 0 && has_tau(row.setting.method)});
            if (!frame) return frame.error();
            row.frames.push_back(*frame);
        }
        return {};
    }

    /// In the flight's own time: the next frame is where the camera is when this one is done.
    Result<void> fly_by_budget(BenchRow& row) {
        FrameBudget budget(options_.budget, *row.setting.tau_px);
        if (auto warm = draw(row.setting, flight_.begin_s(), budget.tau_px(), {}); !warm) return warm.error();
        const double length = std::min(options_.budget_s, flight_.duration_s());
        for (double time = 0; time <= length;) {
            const auto frame = draw(row.setting, flight_.begin_s() + time, budget.tau_px(), {}, &budget);
            if (!frame) return frame.error();
            const FrameCost cost{frame->frame_ms(), frame->triangles,
                                 mesher_.terrain().tiles().figures().memory_load};
            budget.add(cost);
            row.frames_within_budget += budget.holds(cost);
            row.frames.push_back(*frame);
            time += std::max(frame->frame_ms(), 1.0) / 1000;
        }
        return {};
    }

    ViewState state_at(double time_s) const {
        ViewState state = options_.look;
        put(state, flight_.at(time_s));
        return state;
    }

    /// What is measured of a frame besides its time.
    struct Measure {
        bool error = false;
        bool jump = false;
    };

    Result<BenchFrame> draw(const BenchSetting& setting, double time_s, double tau_px, const Measure& measure,
                            FrameBudget* budget = nullptr) {
        const ViewState state = state_at(time_s);
        const lod::View view(camera_of(state, heights_, options_.width, options_.height));
        const auto made = mesher_.make(view, state, setting, tau_px, budget);
        if (!made) return made.error();
        BenchFrame frame;
        frame.run = run_;
        frame.time_s = time_s;
        frame.tau_px = budget ? budget->tau_px() : tau_px;
        frame.refine_ms = made->refine_ms;
        frame.triangles = triangles(made->ground);
        frame.vertices = vertices(made->ground);

        const auto upload = Clock::now();
        renderer_.upload(made->ground);
        frame.upload_ms = ms_since(upload);
        const DrawSettings settings = draw_settings(state);
        const PicturePart all{0, 0, options_.width, options_.height};
        if (mesher_.waits()) {
            if (auto there = renderer_.complete(view, settings, all); !there) return there.error();
        }
        const auto start = Clock::now();
        const auto drawn = renderer_.draw(view, settings, target_);
        if (!drawn) return drawn.error();
        gl_finish();
        frame.draw_ms = ms_since(start);
        frame.draw_calls = drawn->draw_calls;
        frame.resident_mib = resident_mib();
        const lod::TileStore::Figures tiles = mesher_.terrain().tiles().figures();
        frame.tiles_mib = static_cast<double>(tiles.resident_bytes) / (1 << 20);
        frame.pending_tiles = tiles.pending_tiles;

        if (measure.error) {
            frame.error =
                lod::measure_error(mesher_.terrain(), view, mesher_.mesh(view, *made), state.exaggeration);
            malloc_trim(0);  // what measuring took is not the method's memory
        }
        if (measure.jump) {
            auto jump = jump_after(setting, time_s, tau_px, mesher_.mesh(view, *made), view.eye());
            if (!jump) return jump.error();
            frame.jump = *jump;
        }
        return frame;
    }

    Result<std::optional<lod::SurfaceJump>> jump_after(const BenchSetting& setting, double time_s,
                                                       double tau_px, const lod::Mesh& mesh,
                                                       const geo::Ecef& eye) {
        const ViewState state = state_at(time_s + kJumpStepS);
        const lod::View view(camera_of(state, heights_, options_.width, options_.height));
        const lod::Mesh before = mesh;  // the next one takes its place
        const auto after = mesher_.make(view, state, setting, tau_px);
        if (!after) return after.error();
        const geo::GridFrame& grid = scene_.info().frame;
        return lod::surface_jump(before, eye, mesher_.mesh(view, *after), view, grid.columns, grid.rows);
    }

    const lod::Scene& scene_;
    const EyeHeight& heights_;
    const FlightPath& flight_;
    const BenchOptions& options_;
    int run_;
    BenchMesher& mesher_;
    Renderer& renderer_;
    const RenderTarget& target_;
};

}  // namespace

Result<BenchResult> run_bench(const lod::Scene& scene, const EyeHeight& heights, const FlightPath& flight,
                              const BenchOptions& options, const std::function<void(double)>& progress) {
    const auto start = Clock::now();
    BenchResult result;
    result.machine = describe_machine();
    const auto context = OffscreenContext::create();
    if (!context) return context.error();
    result.machine.gl_renderer = gl_description();
    const auto target = RenderTarget::create(options.width, options.height, options.samples);
    if (!target) return target.error();

    for (const BenchSetting& setting : bench_settings(options)) result.rows.push_back({setting, {}, 0});
    const auto all = static_cast<double>(result.rows.size()) * options.runs;
    double done = 0;
    progress(0);
    for (int run = 0; run < options.runs; ++run) {
        for (const BenchMethod method : options.methods) {
            for (const bool by_budget : {false, true}) {
                std::vector<BenchRow*> rows;
                for (BenchRow& row : result.rows) {
                    if (row.setting.method == method && row.setting.by_budget == by_budget)
                        rows.push_back(&row);
                }
                if (rows.empty()) continue;
                // Each method alone in memory.
                const auto paging =
                    by_budget ? BenchMesher::Paging::as_it_comes : BenchMesher::Paging::waited_for;
                auto mesher = BenchMesher::create(scene, method, options, paging);
                if (!mesher && mesher.error().kind == ErrorKind::usage) {
                    if (run == 0) result.skipped.push_back({method, mesher.error().message});
                    continue;
                }
                if (!mesher) return mesher.error();
                const lod::Terrain& terrain = (*mesher)->terrain();
                auto renderer = Renderer::create(terrain, {.pyramid = terrain.pyramid().get(),
                                                           .facts = ground_facts(scene.info()),
                                                           .cache_bytes = options.ground_bytes,
                                                           .heights = &heights});
                if (!renderer) return renderer.error();
                malloc_trim(0);
                MethodRun flown(scene, heights, flight, options, run, **mesher, *renderer, *target);
                for (BenchRow* row : rows) {
                    if (auto finished = flown.fly(*row); !finished) return finished.error();
                    progress(std::min(++done / all, 0.999));
                }
            }
        }
    }
    std::erase_if(result.rows, [](const BenchRow& row) { return row.frames.empty(); });
    progress(1);
    result.seconds = ms_since(start) / 1000;
    return result;
}

}  // namespace relevo::viewer
