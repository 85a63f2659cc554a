#include "viewer/offscreen.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "lod/soar/pick.hpp"
#include "viewer/camera.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/marks/label_keeper.hpp"
#include "viewer/marks/legend.hpp"

namespace relevo::viewer {

namespace {

class Stopwatch {
  public:
    double ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Largest side of what is drawn at once: with 8 samples by twice the width, 0.3 GiB.
int largest_side(int samples) {
    return samples == 1 ? 4096 : 2048;
}
constexpr int kSmallestSide = 256;

/// Side of the tiles: the largest for which the ground that each of them wants has room.
int tile_side(Renderer& renderer, const lod::View& view, const DrawSettings& settings,
              const PictureRequest& request) {
    const auto fits = [&](int side) {
        for (int y = 0; y < request.height; y += side) {
            for (int x = 0; x < request.width; x += side) {
                if (!renderer.ground_fits(view, settings, {x, y, side, side})) return false;
            }
        }
        return true;
    };
    int side = largest_side(request.samples);
    while (side > kSmallestSide && !fits(side)) side /= 2;
    return side;
}

}  // namespace

bool ground_must_show(const lod::Terrain& terrain, const lod::View& view, const ViewState& state) {
    const auto hits = [&](double x, double y) {
        return lod::pick_exactly(terrain, view.eye(), view.ray({x, y}), state.exaggeration).has_value();
    };
    const int width = view.camera().width;
    const int height = view.camera().height;
    const double reach = 1 + 2 * (state.method == Method::full ? 0 : state.tau_px);
    for (int i = 0; i < 9; ++i) {
        for (int k = 0; k < 9; ++k) {
            const double x = width * (i + 0.5) / 9;
            const double y = height * (k + 0.5) / 9;
            const bool inside = x >= reach && y >= reach && x <= width - reach && y <= height - reach;
            if (inside && hits(x, y) && hits(x - reach, y) && hits(x + reach, y) && hits(x, y - reach) &&
                hits(x, y + reach)) {
                return true;
            }
        }
    }
    return false;
}

OffscreenPainter::OffscreenPainter(std::optional<OffscreenContext> context, Renderer renderer,
                                   const lod::Terrain& terrain, const GroundFacts& facts,
                                   const EyeHeight& heights)
    : context_(std::move(context)),
      renderer_(std::move(renderer)),
      mesher_(std::make_unique<Mesher>(terrain)),
      terrain_(terrain),
      facts_(facts),
      heights_(heights) {}

Result<OffscreenPainter> OffscreenPainter::create(const lod::Terrain& terrain, const GroundData& ground,
                                                  const EyeHeight& heights) {
    auto context = OffscreenContext::create();
    if (!context) return context.error();
    auto renderer = Renderer::create(terrain, ground);
    if (!renderer) return renderer.error();
    return OffscreenPainter(*std::move(context), *std::move(renderer), terrain, ground.facts, heights);
}

Result<OffscreenPainter> OffscreenPainter::create_here(const lod::Terrain& terrain, const GroundData& ground,
                                                       const EyeHeight& heights) {
    auto renderer = Renderer::create(terrain, ground);
    if (!renderer) return renderer.error();
    return OffscreenPainter(std::nullopt, *std::move(renderer), terrain, ground.facts, heights);
}

Result<FinishedPicture> draw_picture(const lod::Terrain& terrain, const GroundData& ground,
                                     const EyeHeight& heights, const ViewState& view,
                                     const PictureRequest& request) {
    auto painter = OffscreenPainter::create(terrain, ground, heights);
    if (!painter) return painter.error();
    return painter->draw(view, request);
}

Result<void> OffscreenPainter::add_marks(const lod::View& view, const ViewState& state, const Marks& marks,
                                         Picture& picture) {
    const lod::Camera& camera = view.camera();
    const double scale = marks_scale(camera.width, camera.height);
    if (!marks_ || marks_->scale() != scale) {
        marks_.reset();
        auto made = PictureMarks::create(scale);
        if (!made) return made.error();
        marks_.emplace(*std::move(made));
    }
    MapMarks drawn{.legend = {}, .scale = {}, .north = marks.north, .labels = {}};
    if (marks.legend) drawn.legend = legend(state, facts_);
    const glm::dvec2 middle(0.5 * camera.width, 0.5 * camera.height);
    if (marks.scale) {
        const auto hit = lod::pick_exactly(terrain_, view.eye(), view.ray(middle), state.exaggeration);
        if (hit) drawn.scale = scale_bar(view, hit->distance_m, 0.22 * camera.width);
    }
    if (marks.labels) {
        // Placed in the same view as a window would show it, so that they are as far apart for their size.
        lod::Camera small = camera;
        small.width = static_cast<int>(std::lround(camera.width / scale));
        small.height = static_cast<int>(std::lround(camera.height / scale));
        drawn.labels = labels_of(renderer_, terrain_, state, lod::View(small));
        for (MapLabel& label : drawn.labels)
            label.pixel *= glm::dvec2(static_cast<double>(camera.width) / small.width,
                                      static_cast<double>(camera.height) / small.height);
    }
    return marks_->draw(drawn, view, picture);
}

Result<FinishedPicture> OffscreenPainter::draw(const ViewState& asked, const PictureRequest& request) {
    ViewState state = asked;
    const lod::View view(camera_of(state, heights_, request.width, request.height));
    DrawSettings settings = draw_settings(state);
    settings.background = request.background;
    const int side = tile_side(renderer_, view, settings, request);
    const auto target =
        RenderTarget::create(std::min(request.width, side), std::min(request.height, side), request.samples);
    if (!target) return target.error();
    FinishedPicture made{Picture(request.width, request.height), {}};
    PictureFigures& figures = made.figures;
    figures.gl = gl_description();

    const auto part = [&](int x, int y) { return PicturePart{x, y, target->width(), target->height()}; };

    // Once for nothing: what is measured below shall not be the making of buffers and the compiling of
    // shaders.
    if (request.max_triangles && state.method != Method::full) {
        std::optional<Error> failure;
        state.tau_px = tau_for_triangles(*request.max_triangles, asked.tau_px, [&](double tau_px) {
            state.tau_px = tau_px;
            const auto tried = mesher_->whole_ground(view, state);
            if (!tried) failure = tried.error();
            return tried ? triangles(*tried) : 0;
        });
        if (failure) return *failure;
    }
    figures.tau_reached_px = state.tau_px;
    const auto first = mesher_->whole_ground(view, state);
    if (!first) return first.error();
    if (request.timed) {
        renderer_.upload(*first);
        if (auto done = renderer_.complete(view, settings, part(0, 0)); !done) return done.error();
        if (auto done = renderer_.draw(view, settings, *target, {}, false); !done) return done.error();
        gl_finish();
    }

    const Stopwatch frame;
    const DrawnGround ground = mesher_->ground(view, state);  // all that it needs is there
    figures.refine_ms = frame.ms();
    figures.triangles = triangles(ground);
    renderer_.upload(ground);
    bool ground_seen = false;
    double loading_ms = 0;
    for (int y = 0; y < request.height; y += target->height()) {
        for (int x = 0; x < request.width; x += target->width()) {
            const Stopwatch loading;
            if (auto done = renderer_.complete(view, settings, part(x, y)); !done) return done.error();
            loading_ms += loading.ms();
            const auto drawn = renderer_.draw(view, settings, *target, {x, y}, true);
            if (!drawn) return drawn.error();
            figures.draw_calls += drawn->draw_calls;
            figures.ocean.add(drawn->ocean);
            ground_seen = ground_seen || drawn->ground_seen;
            target->read_into(made.picture, x, y);
        }
    }
    if (request.marks.any()) {
        if (auto done = add_marks(view, state, request.marks, made.picture); !done) return done.error();
    }
    figures.overlays = overlay_figures(renderer_, settings);
    figures.frame_ms = frame.ms() - loading_ms;
    if (auto done = gl_check("reading the picture"); !done) return done.error();
    if (!ground_seen && ground_must_show(terrain_, view, state)) {
        return Error{ErrorKind::internal, "the ground is in view, but not one of its pixels was drawn (" +
                                              figures.gl + "); nothing was written"};
    }
    if (request.measure_error)
        figures.error = lod::measure_error(terrain_, view, mesher_->mesh(view, ground), state.exaggeration);
    return made;
}

}  // namespace relevo::viewer
