// Relevo on the path that all of these programs fly, as its window draws, in the layer `plain`: lit at the
// vertices.
//
//   relevo_peer SCENE [--lod soar|lstr] [--tau PX] [--morph] [--size WxH] [--frames N] [--errors N]

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#define GLFW_INCLUDE_NONE  // epoxy declares OpenGL
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lod/lstr/chunk_making.hpp"
#include "lod/oracle.hpp"
#include "tests/bench/peers/peer_run.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"
#include "viewer/window.hpp"

namespace {

using namespace relevo;

template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return *std::move(result);
}
void must(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().message);
}

/// The path over the middle of a scene, whose middle is the flat world's.
lod::Camera camera_at(const lod::Terrain& terrain, double part, const peers::PeerOptions& options) {
    const geo::GridFrame& frame = terrain.frame();
    const geo::GridPosition middle{0.5 * (frame.columns - 1), 0.5 * (frame.rows - 1)};
    const peers::Place eye = peers::eye_at(part);
    const geo::GridPosition place{middle.column, middle.row - eye.y / frame.spacing(middle).row_m};
    const geo::LatLon at = frame.lat_lon(place);
    lod::Camera camera;
    camera.eye = {at.lat, at.lon, {terrain.undulations().at(place) + eye.z}};
    camera.pitch = geo::Degrees{peers::kPitchDegrees};
    camera.fov = geo::Degrees{peers::kFovDegrees};
    camera.width = options.width;
    camera.height = options.height;
    return camera;
}

/// Of the picture that has just been drawn into what is current, as those of the other engines are measured.
peers::PixelErrors drawn_errors(const lod::Terrain& terrain, const lod::View& view) {
    const int width = view.camera().width;
    const int height = view.camera().height;
    std::vector<float> stored(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
    const geo::GridFrame& frame = terrain.frame();
    lod::TruePosts::Reader posts(terrain.posts());
    const auto H_at = [&](int column, int row) { return static_cast<double>(posts.H(column, row)); };
    std::vector<double> errors;
    auto depth = stored.begin();
    for (int y = 0; y < height; ++y) {  // targets' rows run downwards
        for (int x = 0; x < width; ++x, ++depth) {
            if (*depth == 0) continue;
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const glm::dvec3 ray = view.ray(pixel);
            const double away =
                lod::View::kNearM / static_cast<double>(*depth) / glm::dot(ray, view.forward());
            const geo::Geodetic drawn = geo::to_geodetic({view.eye().m + away * ray});
            const geo::GridPosition at = frame.grid_position({drawn.lat, drawn.lon});
            if (!frame.contains(at)) continue;
            const double N = terrain.undulations().at(at);
            double best = std::numeric_limits<double>::infinity();
            for (const double H : peers::surfaces_at(H_at, frame.columns, frame.rows, at.column, at.row))
                best = std::min(best, glm::distance(pixel, view.pixel(frame.ecef(at, {N + H}) - view.eye())));
            errors.push_back(best);
        }
    }
    return peers::figures_of(errors);
}

int fly(const peers::PeerOptions& options) {
    auto window = must(viewer::Window::create(options.width, options.height, "relevo_peer"));
    glfwSwapInterval(0);
    const double start = peers::seconds();
    const auto scene = must(lod::Scene::open(options.input));
    viewer::ViewState how;
    how.method = must(viewer::parse_method(options.method));
    how.tau_px = options.tau_px;
    how.morph = options.morph;
    auto terrain = must(lod::Terrain::open(scene, lod::ErrorMetric::bounded, {.fade_s = 0}));
    if (how.method == viewer::Method::lstr) must(lod::provide_chunks(scene, terrain));
    auto renderer = must(viewer::Renderer::create(
        terrain, {.pyramid = terrain.pyramid().get(), .facts = viewer::ground_facts(scene.info())}));
    const auto target = must(viewer::RenderTarget::create(options.width, options.height, 1));
    viewer::Mesher mesher(terrain);
    const viewer::DrawSettings settings{.layer = viewer::Layer::plain, .background = {{0.70F, 0.80F, 0.90F}}};

    const peers::PeerProgram program{
        fmt::format("relevo {} {:.3g}{}", options.method, options.tau_px, options.morph ? " morph" : ""),
        [&](double part) -> peers::FrameFigures {
            window.poll(0);
            const lod::View view(camera_at(terrain, part, options));
            const viewer::DrawnGround ground = mesher.ground(view, how);
            renderer.upload(ground);
            const auto drawn = must(renderer.draw(view, settings, target));
            target.show();
            window.show();
            return {static_cast<double>(viewer::triangles(ground)), static_cast<double>(drawn.draw_calls)};
        },
        [&](double part) -> peers::PixelErrors {
            const lod::View view(camera_at(terrain, part, options));
            const viewer::DrawnGround ground = must(mesher.whole_ground(view, how));
            const auto error = lod::measure_error(terrain, view, mesher.mesh(view, ground));
            if (!error || error->uncovered_posts > 0) throw std::runtime_error("the mesh has a hole");
            renderer.upload(ground);
            must(renderer.complete(view, settings, {0, 0, options.width, options.height}));
            must(renderer.draw(view, settings, target));
            peers::PixelErrors errors = drawn_errors(terrain, view);
            errors.oracle_max_px = error->max_px;
            return errors;
        }};
    // All that the path needs is read before it is flown, as the other engines have it: frames are then of
    // the errors that are measured. It counts as loading.
    const int stops = std::max(options.frames, 1);
    for (int k = 0; k <= stops; ++k) {
        const lod::View view(camera_at(terrain, static_cast<double>(k) / stops, options));
        must(mesher.whole_ground(view, how));
        must(renderer.complete(view, settings, {0, 0, options.width, options.height}));
    }
    program.frame(0);
    peers::run_peer(options, program, peers::seconds() - start);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options =
        peers::parse_options(argc, argv, "relevo_peer SCENE [--lod soar|lstr] [--tau PX] [--morph]");
    if (!options) return 2;
    try {
        return fly(*options);
    } catch (const std::exception& failure) {
        fmt::print(stderr, "{}: {}\n", options->input, failure.what());
        return 5;
    }
}
