#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

#include "lod/view.hpp"
#include "tests/lod/synthetic_terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"

namespace relevo::test {

inline constexpr std::array<float, 3> kMagenta{1, 0, 1};

inline bool is_magenta(const std::array<int, 3>& pixel) {
    return pixel == std::array<int, 3>{255, 0, 255};
}

template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return *std::move(result);
}

inline void must(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().message);
}

/// The ground of a terrain in memory.
inline viewer::GroundData ground_of(const lod::Terrain& terrain,
                                    std::shared_ptr<const viewer::GroundMap> map = nullptr,
                                    viewer::Drapes drapes = {}) {
    return {.pyramid = terrain.pyramid().get(),
            .facts = must(viewer::ground_facts(*terrain.pyramid())),
            .map = std::move(map),
            .drapes = std::move(drapes)};
}

/// An off-screen context and a renderer for one terrain: draws any view of it.
class Studio {
  public:
    explicit Studio(lod::Terrain terrain, std::shared_ptr<const viewer::GroundMap> map = nullptr,
                    viewer::Drapes drapes = {})
        : context_(must(viewer::OffscreenContext::create())),
          terrain_(std::make_unique<lod::Terrain>(std::move(terrain))),
          renderer_(must(
              viewer::Renderer::create(*terrain_, ground_of(*terrain_, std::move(map), std::move(drapes))))),
          mesher_(*terrain_) {}

    const lod::Terrain& terrain() const { return *terrain_; }
    viewer::Renderer& renderer() { return renderer_; }

    /// The picture of a camera, with the mesh that `how` asks for.
    viewer::Picture draw(const lod::Camera& camera, const viewer::DrawSettings& settings,
                         const viewer::ViewState& how = {}, int samples = 1) {
        const lod::View view(camera);
        viewer::ViewState state = how;
        state.exaggeration = settings.exaggeration;
        return draw(view, must(mesher_.whole_ground(view, state)), settings, samples);
    }

    viewer::Picture draw(const lod::View& view, const viewer::DrawnGround& ground,
                         const viewer::DrawSettings& settings, int samples = 1) {
        const int width = view.camera().width;
        const int height = view.camera().height;
        const auto target = must(viewer::RenderTarget::create(width, height, samples));
        renderer_.upload(ground);
        must(renderer_.complete(view, settings, {0, 0, width, height}));
        figures = must(renderer_.draw(view, settings, target, {}, true));
        viewer::Picture picture(width, height);
        target.read_into(picture, 0, 0);
        return picture;
    }

    viewer::DrawFigures figures;  ///< of the last picture

  private:
    viewer::OffscreenContext context_;
    std::unique_ptr<lod::Terrain> terrain_;
    viewer::Renderer renderer_;
    viewer::Mesher mesher_;
};

/// Straight down on a place of the grid.
inline lod::Camera above_looking_down(const lod::Terrain& terrain, double column, double row, double metres,
                                      int width = 200, int height = 150) {
    return {.eye = above(terrain, column, row, metres),
            .heading = geo::Degrees{0},
            .pitch = geo::Degrees{-90},
            .roll = geo::Degrees{0},
            .fov = geo::Degrees{40},
            .width = width,
            .height = height};
}

}  // namespace relevo::test
