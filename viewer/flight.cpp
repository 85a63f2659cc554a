#include "viewer/flight.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "geo/coordinate_text.hpp"
#include "geo/geodesic.hpp"
#include "lod/soar/pick.hpp"
#include "viewer/camera.hpp"
#include "viewer/error_probe.hpp"
#include "viewer/flight_keys.hpp"
#include "viewer/frame_times.hpp"
#include "viewer/gl_check.hpp"
#include "viewer/gl_memory.hpp"
#include "viewer/label_keeper.hpp"
#include "viewer/measuring.hpp"
#include "viewer/mesher.hpp"
#include "viewer/motion.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/picture_notes.hpp"
#include "viewer/recording.hpp"
#include "viewer/renderer.hpp"
#include "viewer/scene_facts.hpp"
#include "viewer/tool_list.hpp"
#include "viewer/ui/panels.hpp"

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
        : desk_(desk),
          window_(desk.window()),
          scene_(scene),
          terrain_(terrain),
          ground_(ground),
          heights_(heights),
          options_(options),
          renderer_(std::move(renderer)),
          mesher_(terrain, options.chunks),
          motion_(terrain, heights, options.forward_m_s),
          sampler_(scene),
          measuring_(scene, terrain, heights),
          budget_(options.budget, start.tau_px),
          view_(start),
          facts_(scene_facts(scene.info())) {
        panels_.picture_marks = options.picture_marks;
        if (options.play) motion_.play(*options.play);
        if (!options.record.empty()) recording_.emplace(options.record);
        figures_.gl = gl_description();
        figures_.samples = options.samples != 0 ? options.samples : gl_is_software() ? 1 : 4;
    }

    Result<FlightFigures> run() {
        while (!window_.should_close()) {
            const bool busy = desk_.import() != nullptr || error_.busy() || measuring_.busy();
            const bool idle = ground_rests() && !waves_move() && !motion_.moving(window_) &&
                              options_.frames == 0 && still_frames_ > kSettlingFrames && budget_rests();
            const Input& input = window_.poll(!idle ? 0 : busy ? 0.05 : 0.5);
            still_frames_ = input.anything ? 0 : still_frames_ + 1;
            if (options_.must_close()) break;
            desk_.see_to_import();
            if (desk_.has_next()) break;
            if (idle && !busy && !input.anything && !desk_.message_expired()) continue;
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
        if (auto done = end_recording(); !done) return done.error();
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

    /// At rest the budget goes on until tau does, too; but noise does not keep it going for ever.
    bool budget_rests() const { return budget_.at_rest() || still_frames_ > kBudgetFrames; }

    Result<void> end_recording() {
        if (!recording_) return {};
        const auto written = recording_->write();
        recording_.reset();
        if (!written) return written.error();
        if (*written) say(**written);
        return {};
    }

    void tell(std::string message) { desk_.tell(std::move(message)); }

    /// What the user asked for: printed, and shown for a while.
    void say(const std::string& line) {
        options_.say(line);
        tell(line);
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
        desk_.begin(input);
        measuring_.update(units());
        Input ground_input = for_the_ground(input);
        const lod::View seen = view_in(width, height);
        measuring_.take_drag(ground_input, seen, view_.exaggeration,
                             [&](const glm::dvec2& pixel) { return place_at(seen, pixel); });
        motion_.move(view_, window_, ground_input, dt, width, height);
        if (waves_move()) view_.ocean.time_s += dt;
        if (auto done = read_ground(view_in(width, height), ground_input); !done) return done;
        // After the ground is read: what a key copies is what the cursor, moved in the same moment, is at.
        screenshot_ = false;
        for (const Input::Key& key : ground_input.pressed) obey({press_key(view_, key), {}}, width, height);
        for (const std::string& path : input.dropped) drop(path);
        if (recording_) recording_->see(view_, start);
        const lod::View view = view_in(width, height);
        line_m_.reset();
        if (ground_input.cursor_inside)
            line_m_ = measuring_.distance_at(view, ground_input.cursor, 12, view_.exaggeration);
        if (auto done = draw(view); !done) return done;
        for (const Wish& wish : draw_interface(view)) obey(wish, width, height);
        // Without the wait for the screen, which a frame does not take longer for.
        if (options_.budget.frame_ms) gl_finish();
        const double memory_load = view_.method == Method::soar   ? terrain_.tiles().figures().memory_load
                                   : view_.method == Method::lstr ? mesher_.chunk_figures().store.memory_load
                                                                  : 0;
        const FrameCost cost{ms_since(start), figures_.triangles, memory_load};
        budget_.add(cost);
        within_budget_ += budget_.holds(cost);
        if (screenshot_) {
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
            const auto hit = hit_at(input.cursor);
            auto under = measure(hit);
            if (!under) return under.error();
            cursor_ = *under;
            cursor_is_preview_ = hit && !hit->is_exact;
        }
        if (input.double_click) {
            measuring_.take_back_click();
            if (const auto there = hit_at(*input.double_click)) go_near(view, *input.double_click, *there);
        } else {
            for (const glm::dvec2& click : input.clicks) {
                // What is measured does not depend on what is in memory.
                if (const auto place = place_at(view, click)) set_point(*place);
            }
        }
        const auto middle = hit_at({0.5 * view.camera().width, 0.5 * view.camera().height});
        middle_distance_.reset();
        if (middle) middle_distance_ = middle->distance_m;
        return {};
    }

    /// Of the full data, whatever is in memory.
    std::optional<geo::LatLon> place_at(const lod::View& view, const glm::dvec2& pixel) const {
        const auto hit = lod::pick_exactly(terrain_, view.eye(), view.ray(pixel), view_.exaggeration);
        if (!hit) return std::nullopt;
        geo::LatLon place = terrain_.frame().lat_lon(hit->place);
        place.lon = geo::wrapped_180(place.lon);  // a grid runs on across the antimeridian
        return place;
    }

    void set_point(geo::LatLon place) {
        measuring_.click(place);
        const Shape& shape = measuring_.tool().shapes()[*measuring_.tool().current()];
        const std::vector<geo::LatLon>& places = shape.measurement.vertices;
        if (shape.tool != Tool::line || shape.open) return;
        const geo::GeodesicLine line = geo::geodesic(places[0], places[1]);
        options_.say(
            fmt::format("distance {:.4f} m, azimuth {:.6f} degrees", line.length_m, line.azimuth1.value));
    }

    geo::UnitSystem units() {
        return geo::unit_system(desk_.settings().units).value_or(geo::UnitSystem::metric);
    }

    Result<void> draw(const lod::View& view) {
        const auto start = Clock::now();
        if (view_.tau_px != finest_) budget_.set_finest(finest_ = view_.tau_px);
        const lod::Mesh& mesh = mesher_.mesh(view, view_, budget_);
        mesh_ = &mesh;
        drawn_.emplace(view);
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

    /// What happened on the ground, and not in panels.
    Input for_the_ground(const Input& input) const {
        Input ground = input;
        if (desk_.ui().has_mouse()) {
            const glm::dvec2 cursor = input.cursor;
            const std::vector<Input::Key> pressed = input.pressed;
            ground = Input{};
            ground.cursor = cursor;
            ground.pressed = pressed;
        }
        if (desk_.ui().has_keys()) ground.pressed.clear();
        return ground;
    }

    std::vector<Wish> draw_interface(const lod::View& view) {
        std::optional<double> reached;
        if (options_.budget.any() || figures_.tau_reached_px > view_.tau_px)
            reached = figures_.tau_reached_px;
        const HudContent content{.view = view_,
                                 .vertical = &scene_.info().vertical,
                                 .cursor = cursor_,
                                 .above_ground_m = motion_.controls().above_ground(view_),
                                 .speed_m_s = motion_.controls().speed(view_),
                                 .triangles = figures_.triangles,
                                 .tau_reached_px = reached,
                                 .tau_limit = options_.budget.any() ? "budget" : "memory",
                                 .playing = motion_.playing(),
                                 .recording = recording_.has_value(),
                                 .following = motion_.controls().following(),
                                 .frame_ms = frame_times_.shown(),
                                 .pending = pending(),
                                 .middle_distance_m = middle_distance_,
                                 .message = desk_.message(),
                                 .cursor_is_preview = cursor_is_preview_,
                                 .keys_shown = panels_.keys_shown,
                                 .panel_width = hidden_ ? 0 : panels_.panel_width(desk_),
                                 .tools = tools(),
                                 .facts = facts_,
                                 .labels = labels_.labels(terrain_, renderer_, view_, view, ground_rests()),
                                 .legend = legend(view_, ground_.facts),
                                 .error = error_.report()};
        std::vector<Wish> wishes;
        if (!hidden_) {
            std::optional<geo::Ecef> pin;
            if (plot_m_) pin = measuring_.place_at(*plot_m_, view_.exaggeration);
            draw_marks(content, measuring_.drawn(view_.exaggeration), pin, view);
            draw_panels(content);
            wishes =
                panels_.draw(desk_, view_, content, scene_name(), key_frames_, measuring_, line_m_, plot_m_);
        }
        desk_.end();
        return wishes;
    }

    /// As settings name the scene.
    std::string scene_name() const {
        std::error_code failed;
        return std::filesystem::absolute(scene_.path(), failed).lexically_normal().string();
    }

    void obey(const Wish& wish, int width, int height) {
        switch (wish.command) {
            case Command::none:
                break;
            case Command::open_file:
                panels_.show_chooser();
                break;
            case Command::show_keys:
                panels_.keys_shown = !panels_.keys_shown;
                break;
            case Command::show_panel:
                desk_.show_panel(!desk_.panel_shown());
                break;
            case Command::hide_all:
                hidden_ = !hidden_;
                break;
            case Command::light_or_dark:
                desk_.settings().light = !desk_.settings().light;
                desk_.look_again();
                break;
            case Command::go_to:
                go_to(wish.text);
                break;
            case Command::add_bookmark:
                add_bookmark();
                break;
            case Command::copy_place:
                copy_place();
                break;
            case Command::copy_view:
                copy("view", to_string(view_));
                break;
            case Command::paste_view:
                paste_view(wish.text.empty() ? window_.clipboard() : wish.text);
                break;
            case Command::whole_scene:
                look_over(view_, terrain_, scene_.info(), heights_, width, height);
                break;
            case Command::level:
                view_.pitch = view_.roll = geo::Degrees{0};
                break;
            case Command::follow_ground:
                tell(motion_.controls().toggle_following(view_) ? "following the ground"
                                                                : "not following the ground");
                break;
            case Command::record:
                toggle_recording();
                break;
            case Command::add_key_frame:
                key_frames_.keys.push_back(key_of(view_, 0));
                tell(fmt::format("key frame {}", key_frames_.keys.size()));
                break;
            case Command::play_key_frames:
                play_key_frames();
                break;
            case Command::measure_error:
                if (drawn_) error_.begin(terrain_, *drawn_, *mesh_, view_.exaggeration, view_.tau_px);
                desk_.show_panel(true);
                break;
            case Command::screenshot:
                screenshot_ = true;
                break;
            case Command::large_screenshot:
                take_large_screenshot(width, height);
                break;
            case Command::clear:
                if (!panels_.close()) measuring_.tool().clear();
                break;
            case Command::close:
                window_.close();
                break;
            case Command::undo:
                if (!measuring_.tool().undo()) tell("nothing to undo");
                break;
            case Command::redo:
                if (!measuring_.tool().redo()) tell("nothing to do again");
                break;
            case Command::finish_shape:
                measuring_.tool().finish();
                break;
            case Command::delete_vertex:
                measuring_.tool().delete_vertex();
                break;
            case Command::save_measurements:
                save_measurements();
                break;
            case Command::tool_point:
            case Command::tool_line:
            case Command::tool_path:
            case Command::tool_area:
            case Command::tool_sight:
                take_tool(wish.command);
                break;
        }
    }

    void take_tool(Command command) {
        for (const ToolChoice& choice : kTools) {
            if (choice.command != command) continue;
            measuring_.tool().take(choice.tool);
            tell(fmt::format("{}: {}", choice.name, choice.what));
        }
    }

    std::vector<ToolButton> tools() const {
        std::vector<ToolButton> buttons;
        for (const ToolChoice& choice : kTools)
            buttons.push_back(
                {choice.name, choice.command, choice.what, measuring_.tool().tool() == choice.tool});
        return buttons;
    }

    void save_measurements() {
        const std::vector<Shape>& shapes = measuring_.tool().shapes();
        std::vector<Shape> whole;
        std::vector<const ShapeResult*> results;
        for (const Shape& shape : shapes) {
            if (!is_measurable(shape)) continue;
            whole.push_back(shape);
            results.push_back(measuring_.results().find(shape));
        }
        if (whole.empty()) return tell("nothing is measured yet");
        const auto file = fresh_file(options_.output_folder, "measurements", "geojson");
        if (auto done = options_.files.save(whole, results, file); !done) return tell(done.error().message);
        say(fmt::format("measurements {}", file.string()));
    }

    /// Measurements of a file are shown; anything else is opened.
    void drop(const std::filesystem::path& path) {
        if (!options_.files.is_one || !options_.files.is_one(path)) return desk_.open(path);
        const auto loaded = options_.files.load(path);
        if (!loaded) return tell(loaded.error().message);
        measuring_.tool().insert_shapes(*loaded);
        desk_.show_panel(true);
        tell(fmt::format("{}: {} measurements", path.filename().string(), loaded->size()));
    }

    /// Towards what was clicked twice: a third of the way is left, or 50 m.
    void go_near(const lod::View& view, const glm::dvec2& pixel, const lod::Hit& there) {
        const geo::Geodetic target = geo::to_geodetic(view.eye() + there.distance_m * view.ray(pixel));
        ViewState to = view_;
        look_at(to, heights_, target, std::max(there.distance_m / 3, 50.0));
        motion_.fly_to(view_, to);
    }

    /// To a place, in the middle of the picture and as far away as what is there now; or to a view. Asks
    /// where there is no text.
    void go_to(const std::string& text) {
        if (text.empty()) return panels_.show_go_to();
        if (text.find('/') != std::string::npos) return paste_view(text);
        const auto place = geo::parse_lat_lon(text);
        if (!place) return panels_.complain_of_go_to(place.error().message);
        const double ground_m = ground_height(terrain_, *place, view_.exaggeration)
                                    .value_or(geo::EllipsoidalHeight{heights_.undulation(*place).m})
                                    .m;
        ViewState to = view_;
        look_at(to, heights_, {place->lat, place->lon, {ground_m}},
                std::clamp(middle_distance_.value_or(5000), 100.0, 1e6));
        motion_.fly_to(view_, to);
    }

    void paste_view(const std::string& text) {
        const auto view = parse_view_state(text, view_);
        if (!view) return tell(fmt::format("this is no view: {}", view.error().message));
        ViewState to = *view;
        to.ocean.map = view_.ocean.map;
        to.metric = view_.metric;  // the terrain is open for it
        if (to.method == Method::lstr && terrain_.chunks() == nullptr) {
            to.method = view_.method;
            tell("nodes are drawn where the window is opened with --lod lstr");
        }
        std::swap(to, view_);  // how it is drawn at once, where one is by a short flight
        const ViewState there = view_;
        put(view_, key_of(to, 0));
        motion_.fly_to(view_, there);
    }

    void add_bookmark() {
        std::vector<Bookmark>& marks = desk_.settings().bookmarks;
        marks.push_back({place_text(view_.place), scene_name(), to_string(view_)});
        desk_.show_panel(true);
        desk_.save();
        tell("bookmark added");
    }

    void toggle_recording() {
        if (recording_) {
            if (auto done = end_recording(); !done) tell(done.error().message);
        } else {
            recording_.emplace(fresh_file(options_.output_folder, "flight", "flight"));
            tell("recording; R again ends it");
        }
    }

    void play_key_frames() {
        std::vector<FlightKey> keys = key_frames_.keys;
        for (std::size_t i = 0; i < keys.size(); ++i)
            keys[i].time_s = static_cast<double>(i) * key_frames_.seconds_between;
        if (keys.size() < 2) return tell("a path needs two key frames (K) at least");
        auto path = FlightPath::create(std::move(keys));
        if (!path) return tell(path.error().message);
        const auto file = fresh_file(options_.output_folder, "path", "flight");
        if (auto done = write_flight(*path, file); !done) return tell(done.error().message);
        say(fmt::format("path {}", file.string()));
        motion_.play(*std::move(path));
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

    PictureNotes notes(const Picture& picture) const {
        return picture_notes(scene_, terrain_, heights_, view_, picture.width, picture.height);
    }

    Result<void> take_screenshot() {
        const auto file = fresh_file(options_.output_folder, "relevo", "png");
        const Picture picture = window_.read_back();
        if (auto done = write_picture(picture, file, notes(picture)); !done) return done;
        say(fmt::format("screenshot {}", file.string()));
        return {};
    }

    /// Four times as wide and as high as the window, without read-outs, as `render` draws it.
    void take_large_screenshot(int width, int height) {
        constexpr int kTimes = 4;
        const int times = std::min(kTimes, kLargestPicture / std::max(width, height));
        const auto file = fresh_file(options_.output_folder, "relevo", "png");
        auto painter = OffscreenPainter::create_here(terrain_, ground_, heights_);
        if (!painter) return tell(painter.error().message);
        const auto drawn = painter->draw(view_, {.width = times * width,
                                                 .height = times * height,
                                                 .samples = 1,
                                                 .timed = false,
                                                 .marks = panels_.picture_marks});
        if (!drawn) return tell(drawn.error().message);
        if (auto done = write_picture(drawn->picture, file, notes(drawn->picture)); !done)
            return tell(done.error().message);
        say(fmt::format("picture {}", file.string()));
    }

    Desk& desk_;
    Window& window_;
    const lod::Scene& scene_;
    const lod::Terrain& terrain_;
    const GroundData& ground_;
    const EyeHeight& heights_;
    const FlightOptions& options_;
    Renderer renderer_;
    std::optional<RenderTarget> target_;
    Mesher mesher_;
    Motion motion_;
    lod::HeightSampler sampler_;
    Measuring measuring_;
    FrameBudget budget_;
    std::optional<Recording> recording_;
    ViewState view_;
    double finest_ = view_.tau_px;  // tau, as the budget knows it
    std::uint64_t within_budget_ = 0;

    Panels panels_;
    Panels::KeyFrames key_frames_;
    ErrorProbe error_;
    std::vector<std::string> facts_;
    const lod::Mesh* mesh_ = nullptr;  // of the last frame
    std::optional<lod::View> drawn_;   // likewise
    std::optional<lod::PointMeasurement> cursor_;
    bool cursor_is_preview_ = false;
    std::optional<double> middle_distance_;
    std::optional<double> line_m_;  // along the current shape, where the cursor is on the ground
    std::optional<double> plot_m_;  // likewise, where it is in the profile
    LabelKeeper labels_;
    bool hidden_ = false;
    bool screenshot_ = false;
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
