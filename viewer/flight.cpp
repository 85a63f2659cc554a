#include "viewer/flight.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "geo/coordinate_text.hpp"
#include "lod/soar/pick.hpp"
#include "viewer/camera.hpp"
#include "viewer/flight_controls.hpp"
#include "viewer/flight_keys.hpp"
#include "viewer/flight_recorder.hpp"
#include "viewer/frame_times.hpp"
#include "viewer/gl_check.hpp"
#include "viewer/gl_memory.hpp"
#include "viewer/hud.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"
#include "viewer/ruler.hpp"
#include "viewer/ui.hpp"
#include "viewer/window.hpp"

namespace relevo::viewer {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// One flight: the window, what draws in it, and the state that its user changes.
class Flight {
  public:
    Flight(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights,
           const ViewState& start, const FlightOptions& options, Window window, Ui ui, Renderer renderer)
        : scene_(scene),
          terrain_(terrain),
          heights_(heights),
          options_(options),
          window_(std::move(window)),
          ui_(std::move(ui)),
          renderer_(std::move(renderer)),
          mesher_(terrain, options.chunks),
          controls_(terrain, heights, options.forward_m_s),
          sampler_(scene),
          budget_(options.budget, start.tau_px),
          view_(start),
          playing_(options.play.has_value()) {
        figures_.gl = gl_description();
        figures_.samples = options.samples != 0 ? options.samples : gl_is_software() ? 1 : 4;
    }

    Result<FlightFigures> run() {
        while (!window_.should_close()) {
            const bool idle = ground_rests() && !waves_move() && !playing_ && !controls_.moving(window_) &&
                              options_.frames == 0 && still_frames_ > kSettlingFrames && budget_rests();
            const Input& input = window_.poll(idle ? 0.5 : 0);
            still_frames_ = input.anything ? 0 : still_frames_ + 1;
            if (options_.must_close()) break;
            if (idle && !input.anything && !message_expired()) continue;
            const glm::ivec2 size = window_.size();
            if (size.x <= 0 || size.y <= 0) {  // an icon
                window_.poll(0.1);
                continue;
            }
            if (auto done = frame(input, size.x, size.y); !done) return done.error();
            if (options_.frames != 0 && figures_.frames >= options_.frames) window_.close();
        }
        figures_.frame_ms_median = frame_times_.quantile(0.5);
        figures_.frame_ms_p99 = frame_times_.quantile(0.99);
        figures_.refine_ms_median = refine_times_.quantile(0.5);
        figures_.view = view_;
        if (options_.budget.any() && figures_.frames > 0) {
            figures_.frames_within_budget =
                static_cast<double>(within_budget_) / static_cast<double>(figures_.frames);
        }
        if (auto done = write_record(); !done) return done.error();
        return figures_;
    }

  private:
    /// The user interface needs a few frames to come to rest after an event.
    static constexpr int kSettlingFrames = 3;
    static constexpr double kMessageMs = 4000;
    static constexpr int kBudgetFrames = 100;

    /// What arrives fades in.
    static constexpr double kFadingMs = 1000;

    /// Pieces of meshes and of what colours them that are being read.
    std::size_t pending() const {
        const lod::TileStore::Figures tiles = terrain_.tiles().figures();
        if (view_.method == Method::lstr) {
            const lod::ChunkStore::Figures nodes = mesher_.chunk_figures().store;
            return renderer_.pending() + (nodes.memory_load <= 1 ? nodes.pending_groups : 0);
        }
        const bool coming = view_.method == Method::soar && !tiles.starved();  // else they have no room
        return renderer_.pending() + (coming ? tiles.pending_tiles : 0);
    }

    /// Has all arrived, and faded in?
    bool ground_rests() {
        if (pending() > 0) last_pending_ = Clock::now();
        return ms_since(last_pending_) > kFadingMs;
    }

    bool waves_move() const {
        return figures_.ocean.kind != OceanKind::off && view_.ocean.wind.speed_m_s > 0;
    }

    bool message_expired() {
        if (message_.empty() || ms_since(message_since_) < kMessageMs) return false;
        message_.clear();
        return true;
    }

    /// At rest the budget goes on until tau does, too; but noise does not keep it going for ever.
    bool budget_rests() const { return budget_.at_rest() || still_frames_ > kBudgetFrames; }

    Result<void> write_record() const {
        if (options_.record.empty() || figures_.frames == 0) return {};
        const FlightPath flown = recorder_.finish();
        if (auto done = write_flight(flown, options_.record); !done) return done;
        options_.say(fmt::format("flight {}: {:.1f} s, {} keys", options_.record.string(), flown.duration_s(),
                                 flown.keys().size()));
        return {};
    }

    /// Moves the view: by the recorded flight while it goes on, else as the user says.
    void move(const Input& input, double dt, int width, int height) {
        if (playing_ && controls_.steered(window_, input)) playing_ = false;
        if (!playing_) return controls_.steer(view_, window_, input, dt, width, height);
        if (figures_.frames == 0) flight_start_ = Clock::now();
        const double flown_s = ms_since(flight_start_) / 1000;
        put(view_, options_.play->at(options_.play->begin_s() + flown_s));
        playing_ = flown_s < options_.play->duration_s();
    }

    void tell(std::string message) {
        message_ = std::move(message);
        message_since_ = Clock::now();
    }

    Result<void> frame(const Input& input, int width, int height) {
        const auto start = Clock::now();
        const double dt = std::min(ms_since(last_frame_) / 1000, 0.25);
        last_frame_ = start;
        if (!target_ || target_->width() != width || target_->height() != height) {
            auto made = RenderTarget::create(width, height, figures_.samples);
            if (!made) return made.error();
            target_.emplace(std::move(*made));
        }
        move(input, dt, width, height);
        if (waves_move()) view_.ocean.time_s += dt;
        if (auto done = read_ground(view_in(width, height), input); !done) return done;
        // After the ground is read: what a key copies is what the cursor, moved in the same moment, is at.
        bool screenshot = false;
        for (const Input::Key& key : input.pressed) screenshot |= press(key, width, height);
        if (!options_.record.empty()) {
            if (figures_.frames == 0) record_start_ = start;
            recorder_.see(view_, std::chrono::duration<double>(start - record_start_).count());
        }
        const lod::View view = view_in(width, height);
        if (auto done = draw(view); !done) return done;
        draw_hud(view);
        // Without the wait for the screen, which a frame does not take longer for.
        if (options_.budget.frame_ms) gl_finish();
        const double memory_load = view_.method == Method::soar   ? terrain_.tiles().figures().memory_load
                                   : view_.method == Method::lstr ? mesher_.chunk_figures().store.memory_load
                                                                  : 0;
        const FrameCost cost{ms_since(start), figures_.triangles, memory_load};
        budget_.add(cost);
        within_budget_ += budget_.holds(cost);
        if (screenshot) {
            if (auto done = take_screenshot(); !done) tell(done.error().message);
        }
        window_.show();
        if (auto done = gl_check("drawing the window"); !done) return done;
        frame_times_.add(ms_since(start));
        figures_.frames = frame_times_.count();
        figures_.width = width;
        figures_.height = height;
        return {};
    }

    lod::View view_in(int width, int height) const {
        return lod::View(camera_of(view_, heights_, width, height));
    }

    /// What is under the cursor and in the middle: the place by a ray, the value from the full data.
    Result<void> read_ground(const lod::View& view, const Input& input) {
        const auto hit_at = [&](const glm::dvec2& pixel) {
            return lod::pick(terrain_, view.eye(), view.ray(pixel), view_.exaggeration);
        };
        const auto measure =
            [&](const std::optional<lod::Hit>& hit) -> Result<std::optional<lod::PointMeasurement>> {
            if (!hit) return std::optional<lod::PointMeasurement>{};
            geo::LatLon place = terrain_.frame().lat_lon(hit->place);
            place.lon = geo::wrapped_180(place.lon);  // a grid runs on across the antimeridian
            auto point = lod::measure_point(sampler_, place);
            if (!point) return point.error();
            return std::optional(*point);
        };
        cursor_.reset();
        if (input.cursor_inside) {
            auto under = measure(hit_at(input.cursor));
            if (!under) return under.error();
            cursor_ = *under;
        }
        for (const glm::dvec2& click : input.clicks) {
            // What is measured does not depend on what is in memory.
            const auto point =
                measure(lod::pick_exactly(terrain_, view.eye(), view.ray(click), view_.exaggeration));
            if (!point) return point.error();
            if (*point) {
                ruler_.add(**point);
                if (const auto line = ruler_.line()) {
                    options_.say(fmt::format("distance {:.4f} m, azimuth {:.6f} degrees", line->length_m,
                                             line->azimuth1.value));
                }
            }
        }
        const auto middle = hit_at({0.5 * view.camera().width, 0.5 * view.camera().height});
        middle_distance_.reset();
        if (middle) middle_distance_ = middle->distance_m;
        return {};
    }

    Result<void> draw(const lod::View& view) {
        const auto start = Clock::now();
        if (view_.tau_px != finest_) budget_.set_finest(finest_ = view_.tau_px);
        const lod::Mesh& mesh = mesher_.mesh(view, view_, budget_);
        figures_.tau_reached_px = view_.method == Method::full ? view_.tau_px : budget_.tau_px();
        refine_times_.add(ms_since(start));
        figures_.triangles = mesh.triangles();
        renderer_.upload(mesh);
        const auto drawn = renderer_.draw(view, draw_settings(view_), *target_);
        if (!drawn) return drawn.error();
        figures_.draw_calls = drawn->draw_calls;
        figures_.ocean = drawn->ocean;
        target_->show();
        return {};
    }

    void draw_hud(const lod::View& view) {
        std::optional<double> reached;
        if (options_.budget.any() || figures_.tau_reached_px > view_.tau_px)
            reached = figures_.tau_reached_px;
        const HudContent content{.view = view_,
                                 .vertical = &scene_.info().vertical,
                                 .cursor = cursor_,
                                 .above_ground_m = controls_.above_ground(view_),
                                 .speed_m_s = controls_.speed(view_),
                                 .triangles = figures_.triangles,
                                 .tau_reached_px = reached,
                                 .tau_limit = options_.budget.any() ? "budget" : "memory",
                                 .playing = playing_,
                                 .recording = !options_.record.empty(),
                                 .frame_ms = frame_times_.shown(),
                                 .pending = pending(),
                                 .middle_distance_m = middle_distance_,
                                 .message = message_,
                                 .keys_shown = keys_shown_};
        ui_.begin();
        draw_marks(content, ruler_, ruler_.on_ground(terrain_, view_.exaggeration), view);
        draw_panels(content, ruler_);
        ui_.end();
    }

    /// Does what a key says; true asks for a screenshot of this frame.
    bool press(const Input::Key& key, int width, int height) {
        switch (press_key(view_, key)) {
            case KeyAction::none:
                break;
            case KeyAction::show_keys:
                keys_shown_ = !keys_shown_;
                break;
            case KeyAction::clear_ruler:
                ruler_.clear();
                break;
            case KeyAction::copy_place:
                copy_place();
                break;
            case KeyAction::copy_view:
                copy("view", to_string(view_));
                break;
            case KeyAction::screenshot:
                return true;
            case KeyAction::close:
                window_.close();
                break;
            case KeyAction::whole_scene:
                look_over(view_, terrain_, scene_.info(), heights_, width, height);
                break;
        }
        return false;
    }

    void copy_place() {
        if (!cursor_) return tell("no ground under the cursor to copy");
        std::string text = geo::to_decimal_degrees(cursor_->place);
        if (cursor_->H) text += fmt::format(", {:.3f}", cursor_->H->m);
        copy("coordinates", text);
    }

    void copy(const char* what, const std::string& text) {
        window_.set_clipboard(text);
        options_.say(fmt::format("{} {}", what, text));
        tell(fmt::format("copied the {}", what));
    }

    Result<void> take_screenshot() {
        std::filesystem::path file;
        do {
            file = options_.screenshot_folder / fmt::format("relevo-{:04d}.png", ++screenshots_);
        } while (std::filesystem::exists(file));
        if (auto done = write_picture(window_.read_back(), file, to_string(view_)); !done) return done;
        options_.say(fmt::format("screenshot {}", file.string()));
        tell(fmt::format("wrote {}", file.string()));
        return {};
    }

    const lod::Scene& scene_;
    const lod::Terrain& terrain_;
    const EyeHeight& heights_;
    const FlightOptions& options_;
    // In this order: what is drawn with goes before the context that it lives in.
    Window window_;
    Ui ui_;
    Renderer renderer_;
    std::optional<RenderTarget> target_;
    Mesher mesher_;
    FlightControls controls_;
    lod::HeightSampler sampler_;
    Ruler ruler_;
    FrameBudget budget_;
    FlightRecorder recorder_;
    ViewState view_;
    double finest_ = view_.tau_px;  // tau, as the budget knows it
    bool playing_;
    Clock::time_point flight_start_{};
    Clock::time_point record_start_{};
    std::uint64_t within_budget_ = 0;

    std::optional<lod::PointMeasurement> cursor_;
    std::optional<double> middle_distance_;
    bool keys_shown_ = false;
    std::string message_;
    Clock::time_point message_since_{};
    Clock::time_point last_frame_ = Clock::now();
    Clock::time_point last_pending_{};
    int still_frames_ = 0;
    int screenshots_ = 0;

    FlightFigures figures_;
    FrameTimes frame_times_;
    FrameTimes refine_times_;
};

}  // namespace

Result<FlightFigures> fly(const lod::Scene& scene, const lod::Terrain& terrain, const GroundData& ground,
                          const EyeHeight& heights, const ViewState& start, const FlightOptions& options) {
    auto window = Window::create(options.width, options.height,
                                 fmt::format("{} - Relevo", scene.path().filename().string()));
    if (!window) return window.error();
    auto ui = Ui::create(*window, options.ui_scale > 0 ? options.ui_scale : window->scale());
    if (!ui) return ui.error();
    auto renderer = Renderer::create(terrain, ground);
    if (!renderer) return renderer.error();
    Flight flight(scene, terrain, heights, start, options, std::move(*window), std::move(*ui),
                  std::move(*renderer));
    return flight.run();
}

}  // namespace relevo::viewer
