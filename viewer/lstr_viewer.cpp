#include "viewer/lstr_viewer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "lod/lstr/chunk_making.hpp"

namespace relevo::viewer {

struct LstrViewer::State {
    State(lod::Scene of, lod::Terrain on, const LstrViewerOptions& how)
        : options(how), scene(std::move(of)), terrain(std::move(on)), heights(scene.geoid()) {}

    LstrViewerOptions options;
    double swap_factor = 0;  // of an eye at rest
    lod::Scene scene;
    lod::Terrain terrain;
    EyeHeight heights;
    std::optional<Renderer> renderer;
    std::optional<lod::ChunkMesher> mesher;
    std::optional<lod::View> view;
    std::uint64_t triangles = 0;

    double above_ground_m(const lod::Camera& camera) const {
        const auto ground =
            ground_height(terrain, {camera.eye.lat, camera.eye.lon}, options.look.exaggeration);
        return camera.eye.h.m - (ground ? ground->m : 0);
    }

    void read_ahead(const lod::View& next, double elapsed_s) {
        double speed_m_s = 0;
        if (view && elapsed_s > 0) speed_m_s = glm::length(next.eye().m - view->eye().m) / elapsed_s;
        mesher->selection().swap_factor =
            swap_factor_ahead(swap_factor, speed_m_s, above_ground_m(next.camera()));
    }
};

double swap_factor_ahead(double factor, double speed_m_s, double above_m) {
    constexpr double kReadS = 0.7;  // in which a piece that is asked for has been read, as a rule
    constexpr double kLowestM = 10;
    return factor + std::min(kReadS * speed_m_s / std::max(above_m, kLowestM), 1.0);
}

LstrViewer::LstrViewer(std::unique_ptr<State> state) : state_(std::move(state)) {}
LstrViewer::LstrViewer(LstrViewer&&) noexcept = default;
LstrViewer& LstrViewer::operator=(LstrViewer&&) noexcept = default;
LstrViewer::~LstrViewer() = default;

Result<LstrViewer> LstrViewer::load(const std::filesystem::path& path, const LstrViewerOptions& options) {
    auto scene = lod::Scene::open(path);
    if (!scene) return scene.error();
    auto terrain = lod::Terrain::open(*scene, lod::ErrorMetric::bounded, {});
    if (!terrain) return terrain.error();
    if (auto done = lod::provide_chunks(*scene, *terrain); !done) return done.error();
    const lod::CacheSizes caches =
        options.caches ? *options.caches : lod::cache_sizes(lod::find_machine(path));
    auto state = std::make_unique<State>(*std::move(scene), *std::move(terrain), options);
    auto renderer = Renderer::create(state->terrain, {.pyramid = state->terrain.pyramid().get(),
                                                      .facts = ground_facts(state->scene.info()),
                                                      .cache_bytes = caches.texel_bytes,
                                                      .heights = &state->heights,
                                                      .map = options.ground_map});
    if (!renderer) return renderer.error();
    state->renderer.emplace(*std::move(renderer));
    state->swap_factor = caches.swap_factor;
    lod::ChunkOptions chunks;
    chunks.store.memory_bytes = caches.mesh_bytes;
    chunks.store.threads = caches.threads;
    state->mesher.emplace(state->terrain, *state->terrain.chunks(), chunks);
    return LstrViewer(std::move(state));
}

Result<void> LstrViewer::update(const lod::Camera& camera, double elapsed_s) {
    State& state = *state_;
    const lod::View view(camera);
    state.read_ahead(view, elapsed_s);
    lod::RefineOptions refine = state.options.refine;
    refine.exaggeration = state.options.look.exaggeration;
    const auto picture =
        state.options.waits ? state.mesher->whole_picture(view, refine) : state.mesher->picture(view, refine);
    if (!picture) return picture.error();
    state.renderer->upload(*picture);
    state.triangles = picture->triangles;
    state.view = view;
    return {};
}

Result<DrawFigures> LstrViewer::draw(const RenderTarget& target, double elapsed_s) {
    State& state = *state_;
    assert(state.view);
    DrawSettings& look = state.options.look;
    look.ocean.time_s += elapsed_s;
    if (state.options.waits) {
        const auto there =
            state.renderer->complete(*state.view, look, {0, 0, target.width(), target.height()});
        if (!there) return there.error();
    }
    return state.renderer->draw(*state.view, look, target);
}

DrawSettings& LstrViewer::look() {
    return state_->options.look;
}
lod::RefineOptions& LstrViewer::refine() {
    return state_->options.refine;
}
LstrViewer::Figures LstrViewer::figures() const {
    return {state_->triangles, state_->mesher->figures(), state_->renderer->node_figures(),
            state_->renderer->pending()};
}
const lod::Scene& LstrViewer::scene() const {
    return state_->scene;
}
const lod::Terrain& LstrViewer::terrain() const {
    return state_->terrain;
}
const EyeHeight& LstrViewer::heights() const {
    return state_->heights;
}

}  // namespace relevo::viewer
