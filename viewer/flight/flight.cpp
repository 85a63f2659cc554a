#include "viewer/flight/flight.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "geo/geodesic.hpp"
#include "lod/soar/pick.hpp"
#include "viewer/camera.hpp"
#include "viewer/flight/flight_commands.hpp"
#include "viewer/flight/flight_files.hpp"
#include "viewer/flight/flight_keys.hpp"
#include "viewer/flight/flight_state.hpp"
#include "viewer/flight/frame_times.hpp"
#include "viewer/flight/travel.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_memory.hpp"
#include "viewer/marks/label_keeper.hpp"
#include "viewer/measure/tool_list.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"
#include "viewer/scene_facts.hpp"

namespace relevo::viewer {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// One flight: what draws in the window, and the state that its user changes.
class Flight {
  public:
    Flight(Desk& desk, const lod::Scene& scene, const lod::Terrain& terrain, const GroundData& ground,
           const EyeHeight& heights, const ViewState& start, const FlightOptions& options, Renderer renderer)
        : flight_(desk, scene, terrain, ground, heights, start, options),
          window_(desk.window()),
          renderer_(std::move(renderer)),
          mesher_(terrain, options.chunks),
          sampler_(scene),
          budget_(options.budget, start.tau_px),
          facts_(scene_facts(scene.info())) {
        figures_.gl = gl_description();
        figures_.samples = options.samples != 0 ? options.samples : gl_is_software() ? 1 : 4;
    }

    Result<FlightFigures> run() {
        while (!window_.should_close()) {
            const bool busy = flight_.desk.import() != nullptr || flight_.error.busy() ||
                              flight_.measuring.busy() || flight_.layers.opening();
            const bool idle = ground_rests() && !waves_move() && !flight_.motion.moving(window_) &&
                              flight_.options.frames == 0 && still_frames_ > kSettlingFrames &&
                              budget_rests();
            const Input& input = window_.poll(!idle ? 0 : busy ? 0.05 : 0.5);
            still_frames_ = input.anything ? 0 : still_frames_ + 1;
            if (flight_.options.must_close()) break;
            flight_.desk.see_to_import();
            if (flight_.desk.has_next()) break;
            if (idle && !busy && !input.anything && !flight_.desk.message_expired()) continue;
            const glm::ivec2 size = window_.size();
            if (size.x <= 0 || size.y <= 0) {  // an icon
                window_.poll(0.1);
                continue;
            }
            if (auto done = frame(input, size.x, size.y); !done) return done.error();
            if (flight_.options.frames != 0 && figures_.frames >= flight_.options.frames) window_.close();
        }
        figures_.frame_ms_median = frame_times_.quantile(0.5);
        figures_.frame_ms_p99 = frame_times_.quantile(0.99);
        figures_.refine_ms_median = refine_times_.quantile(0.5);
        figures_.view = flight_.view;
        figures_.overlays = overlay_figures(*renderer_, draw_settings(flight_.view));
        figures_.gl_objects = gl_counts();
        if (flight_.options.budget.any() && figures_.frames > 0) {
            figures_.frames_within_budget =
                static_cast<double>(within_budget_) / static_cast<double>(figures_.frames);
        }
        if (auto done = end_recording(flight_); !done) return done.error();
        return figures_;
    }

  private:
    /// The user interface needs a few frames to come to rest after an event.
    static constexpr int kSettlingFrames = 3;
    static constexpr int kBudgetFrames = 100;

    /// What arrives fades in.
    static constexpr double kFadingMs = 1000;

    /// Pieces of meshes and of what colours them that are being read.
    std::size_t pending() const {
        const lod::TileStore::Figures tiles = flight_.terrain.tiles().figures();
        if (flight_.view.method == Method::lstr) {
            const lod::ChunkStore::Figures nodes = mesher_.chunk_figures().store;
            return renderer_->pending() + (nodes.memory_load <= 1 ? nodes.pending_groups : 0);
        }
        const bool coming =
            flight_.view.method == Method::soar && !tiles.starved();  // else they have no room
        return renderer_->pending() + (coming ? tiles.pending_tiles : 0);
    }

    /// Has all arrived, and faded in?
    bool ground_rests() {
        if (pending() > 0) last_pending_ = Clock::now();
        return ms_since(last_pending_) > kFadingMs;
    }

    bool waves_move() const {
        return figures_.ocean.kind != OceanKind::off && flight_.view.ocean.wind.speed_m_s > 0;
    }

    /// At rest the budget goes on until tau does, too; but noise does not keep it going for ever.
    bool budget_rests() const { return budget_.at_rest() || still_frames_ > kBudgetFrames; }

    Result<void> frame(const Input& input, int width, int height) {
        const auto start = Clock::now();
        const double dt = std::min(ms_since(last_frame_) / 1000, 0.25);
        last_frame_ = start;
        if (!target_ || target_->width() != width || target_->height() != height) {
            auto made = RenderTarget::create(width, height, figures_.samples);
            if (!made) return made.error();
            target_.emplace(std::move(*made));
        }
        flight_.desk.begin(input);
        flight_.measuring.update(units());
        if (auto done = see_to_layers(); !done) return done;
        Input ground_input = for_the_ground(input);
        const lod::View seen = view_in(width, height);
        flight_.measuring.take_mouse(ground_input, seen, flight_.view.exaggeration,
                                     [&](const glm::dvec2& pixel) { return place_at(seen, pixel); });
        flight_.motion.move(flight_.view, window_, ground_input, dt, width, height);
        if (waves_move()) flight_.view.ocean.time_s += dt;
        if (auto done = read_ground(view_in(width, height), ground_input); !done) return done;
        // After the ground is read: what a key copies is what the cursor, moved in the same moment, is at.
        flight_.screenshot_wanted = false;
        for (const Input::Key& key : ground_input.pressed) {
            const auto answer = flight_.panels.answer(key);
            obey(flight_, answer ? *answer : Wish{press_key(flight_.view, key)}, width, height);
        }
        for (const std::string& path : input.dropped) open_path(flight_, path);
        if (flight_.recording) flight_.recording->see(flight_.view, start);
        const lod::View view = view_in(width, height);
        line_m_.reset();
        if (ground_input.cursor_inside)
            line_m_ = flight_.measuring.distance_at(view, ground_input.cursor, 12, flight_.view.exaggeration);
        if (auto done = draw(view); !done) return done;
        for (const Wish& wish : draw_interface(view)) obey(flight_, wish, width, height);
        // Without the wait for the screen, which a frame does not take longer for.
        if (flight_.options.budget.frame_ms) gl_finish();
        const double memory_load =
            flight_.view.method == Method::soar   ? flight_.terrain.tiles().figures().memory_load
            : flight_.view.method == Method::lstr ? mesher_.chunk_figures().store.memory_load
                                                  : 0;
        const FrameCost cost{ms_since(start), figures_.triangles, memory_load};
        budget_.add(cost);
        within_budget_ += budget_.holds(cost);
        if (flight_.screenshot_wanted) {
            if (auto done = take_screenshot(flight_); !done) flight_.tell(done.error().message);
        }
        window_.show();
        if (auto done = gl_check("drawing the window"); !done) return done;
        frame_times_.add(ms_since(start));
        figures_.frames = frame_times_.count();
        figures_.width = width;
        figures_.height = height;
        return {};
    }

    /// Takes in what layers have become since the last frame.
    Result<void> see_to_layers() {
        GroundLayers& layers = flight_.layers;
        if (const auto opened = layers.take_opened()) {
            if (*opened) {
                flight_.say(fmt::format("layer {}", **opened));
            } else {
                flight_.tell(opened->error().message);
            }
        }
        if (auto shown = layers.show_viewshed(flight_.measuring.viewshed()); !shown)
            flight_.tell(shown.error().message);
        if (!layers.take_changed()) return {};
        // Anew: how they share the memory for textures depends on how many there are.
        renderer_.reset();
        auto renderer = Renderer::create(flight_.terrain, flight_.ground);
        if (!renderer) return renderer.error();
        renderer_.emplace(*std::move(renderer));
        last_pending_ = Clock::now();
        return {};
    }

    lod::View view_in(int width, int height) const {
        return lod::View(camera_of(flight_.view, flight_.heights, width, height));
    }

    /// What is under the cursor and in the middle: the place by a ray, the value from the full data.
    Result<void> read_ground(const lod::View& view, const Input& input) {
        const auto hit_at = [&](const glm::dvec2& pixel) {
            return lod::pick(flight_.terrain, view.eye(), view.ray(pixel), flight_.view.exaggeration);
        };
        const auto measure =
            [&](const std::optional<lod::Hit>& hit) -> Result<std::optional<lod::PointMeasurement>> {
            if (!hit) return std::optional<lod::PointMeasurement>{};
            geo::LatLon place = flight_.terrain.frame().lat_lon(hit->place);
            place.lon = geo::wrapped_180(place.lon);  // a grid runs on across the antimeridian
            auto point = lod::measure_point(sampler_, place);
            if (!point) return point.error();
            return std::optional(*point);
        };
        flight_.cursor.reset();
        if (input.cursor_inside) {
            const auto hit = hit_at(input.cursor);
            auto under = measure(hit);
            if (!under) return under.error();
            flight_.cursor = *under;
            cursor_is_preview_ = hit && !hit->is_exact;
        }
        if (input.double_click) {
            flight_.measuring.take_back_click();
            if (const auto there = hit_at(*input.double_click))
                go_near(flight_, view, *input.double_click, *there);
        } else {
            for (const glm::dvec2& click : input.clicks) {
                // What is measured does not depend on what is in memory.
                if (const auto place = place_at(view, click)) set_point(*place);
            }
        }
        const auto middle = hit_at({0.5 * view.camera().width, 0.5 * view.camera().height});
        flight_.middle_distance_m.reset();
        if (middle) flight_.middle_distance_m = middle->distance_m;
        return {};
    }

    /// Of the full data, whatever is in memory.
    std::optional<geo::LatLon> place_at(const lod::View& view, const glm::dvec2& pixel) const {
        const auto hit =
            lod::pick_exactly(flight_.terrain, view.eye(), view.ray(pixel), flight_.view.exaggeration);
        if (!hit) return std::nullopt;
        geo::LatLon place = flight_.terrain.frame().lat_lon(hit->place);
        place.lon = geo::wrapped_180(place.lon);  // a grid runs on across the antimeridian
        return place;
    }

    void set_point(geo::LatLon place) {
        flight_.measuring.click(place);
        const Shape& shape = flight_.measuring.tool().shapes()[*flight_.measuring.tool().current()];
        const std::vector<geo::LatLon>& places = shape.measurement.vertices;
        if (shape.tool != Tool::line || shape.open) return;
        const geo::GeodesicLine line = geo::geodesic(places[0], places[1]);
        flight_.options.say(
            fmt::format("distance {:.4f} m, azimuth {:.6f} degrees", line.length_m, line.azimuth1.value));
    }

    geo::UnitSystem units() {
        return geo::unit_system(flight_.desk.settings().units).value_or(geo::UnitSystem::metric);
    }

    Result<void> draw(const lod::View& view) {
        const auto start = Clock::now();
        if (flight_.view.tau_px != finest_) budget_.set_finest(finest_ = flight_.view.tau_px);
        const DrawnGround ground = mesher_.ground(view, flight_.view, budget_);
        flight_.mesh = [this, view, ground]() -> const lod::Mesh& { return mesher_.mesh(view, ground); };
        flight_.drawn.emplace(view);
        figures_.tau_reached_px =
            flight_.view.method == Method::full ? flight_.view.tau_px : budget_.tau_px();
        refine_times_.add(ms_since(start));
        figures_.triangles = triangles(ground);
        renderer_->upload(ground);
        const auto drawn = renderer_->draw(view, draw_settings(flight_.view), *target_);
        if (!drawn) return drawn.error();
        figures_.draw_calls = drawn->draw_calls;
        figures_.ocean = drawn->ocean;
        target_->show();
        return {};
    }

    /// What happened on the ground, and not in panels.
    Input for_the_ground(const Input& input) const {
        Input ground = input;
        if (flight_.desk.ui().has_mouse()) {
            const glm::dvec2 cursor = input.cursor;
            const std::vector<Input::Key> pressed = input.pressed;
            ground = Input{};
            ground.cursor = cursor;
            ground.pressed = pressed;
        }
        if (flight_.desk.ui().has_keys()) ground.pressed.clear();
        return ground;
    }

    std::vector<Wish> draw_interface(const lod::View& view) {
        if (const auto found = flight_.error.finish()) flight_.say(*found);
        std::optional<double> reached;
        if (flight_.options.budget.any() || figures_.tau_reached_px > flight_.view.tau_px)
            reached = figures_.tau_reached_px;
        const HudContent content{
            .view = flight_.view,
            .vertical = &flight_.scene.info().vertical,
            .cursor = flight_.cursor,
            .above_ground_m = flight_.motion.controls().above_ground(flight_.view),
            .speed_m_s = flight_.motion.controls().speed(flight_.view),
            .triangles = figures_.triangles,
            .tau_reached_px = reached,
            .tau_limit = flight_.options.budget.any() ? "budget" : "memory",
            .playing = flight_.motion.playing(),
            .recording = flight_.recording.has_value(),
            .following = flight_.motion.controls().following(),
            .frame_ms = frame_times_.shown(),
            .pending = pending(),
            .middle_distance_m = flight_.middle_distance_m,
            .message = flight_.desk.message(),
            .cursor_is_preview = cursor_is_preview_,
            .keys_shown = flight_.panels.keys_shown,
            .panel_width = flight_.hidden ? 0 : flight_.panels.panel_width(flight_.desk),
            .covered = flight_.hidden ? Covered{} : covered_,
            .tools = tools(),
            .facts = facts_,
            .labels = labels_.labels(flight_.terrain, *renderer_, flight_.view, view, ground_rests()),
            .legend = legend(flight_.view, flight_.ground.facts),
            .error = flight_.error.report()};
        std::vector<Wish> wishes;
        if (!flight_.hidden) {
            std::optional<geo::Ecef> pin;
            if (plot_m_) pin = flight_.measuring.place_at(*plot_m_, flight_.view.exaggeration);
            draw_marks(content, flight_.measuring.drawn(flight_.view.exaggeration), pin, view);
            draw_handles(flight_.measuring.handles(flight_.view.exaggeration), view);
            covered_ = draw_panels(content);
            flight_.panels.add_covered(flight_.desk, covered_);
            wishes =
                flight_.panels.draw(flight_.desk, flight_.view, content, flight_.scene_name(),
                                    flight_.key_frames, flight_.measuring, flight_.layers, line_m_, plot_m_);
        }
        flight_.desk.end();
        return wishes;
    }

    std::vector<ToolButton> tools() const {
        std::vector<ToolButton> buttons;
        for (const ToolChoice& choice : kTools)
            buttons.push_back(
                {choice.name, choice.command, choice.what, flight_.measuring.tool().tool() == choice.tool});
        return buttons;
    }

    FlightState flight_;
    Window& window_;
    std::optional<Renderer> renderer_;
    std::optional<RenderTarget> target_;
    Mesher mesher_;
    lod::HeightSampler sampler_;
    FrameBudget budget_;
    double finest_ = flight_.view.tau_px;  // tau, as the budget knows it
    std::uint64_t within_budget_ = 0;

    std::vector<std::string> facts_;
    bool cursor_is_preview_ = false;
    std::optional<double> line_m_;  // along the current shape, where the cursor is on the ground
    std::optional<double> plot_m_;  // likewise, where it is in the profile
    LabelKeeper labels_;
    Covered covered_;  // by panels, in the last frame
    Clock::time_point last_frame_ = Clock::now();
    Clock::time_point last_pending_{};
    int still_frames_ = 0;

    FlightFigures figures_;
    FrameTimes frame_times_;
    FrameTimes refine_times_;
};

}  // namespace

Result<FlightFigures> fly(Desk& desk, const lod::Scene& scene, const lod::Terrain& terrain,
                          const GroundData& ground, const EyeHeight& heights, const ViewState& start,
                          const FlightOptions& options) {
    desk.window().set_title(fmt::format("{} - Relevo", scene.path().filename().string()));
    auto renderer = Renderer::create(terrain, ground);
    if (!renderer) return renderer.error();
    Flight flight(desk, scene, terrain, ground, heights, start, options, *std::move(renderer));
    return flight.run();
}

}  // namespace relevo::viewer
