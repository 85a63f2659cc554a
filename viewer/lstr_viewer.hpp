#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "geo/result.hpp"
#include "lod/cache_sizes.hpp"
#include "lod/lstr/chunk_mesher.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/draw_settings.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/gl/render_target.hpp"
#include "viewer/ground/ground_map.hpp"
#include "viewer/renderer.hpp"

namespace relevo::viewer {

struct LstrViewerOptions {
    lod::RefineOptions refine{.tau_px = 1, .morph = true};  ///< its exaggeration is that of `look`
    DrawSettings look = {};
    /// What is kept in memory and how it is read; nothing: what fits the machine.
    std::optional<lod::CacheSizes> caches = {};
    std::shared_ptr<const GroundMap> ground_map = nullptr;  ///< of the layer `terrain`
    /// Pictures are of all that their view asks for, however long that takes to read: for pictures that are
    /// kept. Else of what is there.
    bool waits = false;
};

/// Draws a scene's quadtree, for programs that use the library: the class LSTRVis of the reference (its table
/// 7), in the same three steps. Generating is ingest/lstr_generator.hpp.
///
///     auto viewer = LstrViewer::load("fuji.relevo");
///     ...each frame:
///     if (auto done = viewer->update(camera, elapsed_s); !done) ...
///     if (auto drawn = viewer->draw(target, elapsed_s); !drawn) ...
///     target.show();
///
/// For the thread in which an OpenGL 4.5 context is current that prepare_gl has seen (OffscreenContext is
/// one), from load() to the viewer's end.
class LstrViewer {
  public:
    /// Opens a scene. Its chunks.bin is made first where it is not there, or in memory where it cannot be
    /// written.
    static Result<LstrViewer> load(const std::filesystem::path& scene, const LstrViewerOptions& options = {});

    LstrViewer(LstrViewer&&) noexcept;
    LstrViewer& operator=(LstrViewer&&) noexcept;
    ~LstrViewer();

    /// Takes in what has been read, finds the nodes of a view, and has what is missing and what is near read
    /// in the background. \param elapsed_s  since the last call: a fast eye has more read ahead of it. 0: it
    /// has not flown here
    Result<void> update(const lod::Camera& camera, double elapsed_s);

    /// Draws the last update's view into the upper left corner of its picture, as much as the target holds.
    /// \param elapsed_s  since the last call, by which waves go on
    /// \pre there was an update that did not fail
    Result<DrawFigures> draw(const RenderTarget& target, double elapsed_s);

    /// How it is drawn, to be changed at any time.
    DrawSettings& look();
    lod::RefineOptions& refine();

    /// Triangles of the last update, and what is in memory.
    struct Figures {
        std::uint64_t triangles = 0;
        lod::ChunkMesher::Figures chunks;
        NodeBuffers::Figures in_graphics_memory;
        std::size_t pending_pages = 0;  ///< of the ground's textures
    };
    Figures figures() const;

    const lod::Scene& scene() const;
    const lod::Terrain& terrain() const;
    /// For cameras whose heights are above the scene's vertical datum (camera_of).
    const EyeHeight& heights() const;

  private:
    struct State;
    explicit LstrViewer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// The swap sphere's factor for an eye that flies: what it would pass in the time that a read takes is in
/// the sphere. `above_m` is its height above the ground, about as far as the nearest nodes are.
/// \return  factor to factor + 1: more would push out what is seen
double swap_factor_ahead(double factor, double speed_m_s, double above_m);

}  // namespace relevo::viewer
