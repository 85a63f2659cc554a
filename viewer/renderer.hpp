#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "geo/result.hpp"
#include "lod/mesh.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/draw_settings.hpp"
#include "viewer/drawn_ground.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/gl/render_target.hpp"
#include "viewer/ground/ground_cover.hpp"
#include "viewer/ground/ground_textures.hpp"
#include "viewer/ground/node_buffers.hpp"
#include "viewer/layer.hpp"
#include "viewer/ocean/ocean.hpp"
#include "viewer/overlay/overlay_drawing.hpp"

namespace relevo::viewer {

/// The part of a view's picture that a target shows: pixels from the upper left corner.
struct Region {
    int x = 0;
    int y = 0;
};

struct DrawFigures {
    int draw_calls = 0;
    /// Did any sample of the ground or of the sea pass? Found out only where `draw` is to measure.
    bool ground_seen = false;
    OceanFigures ocean;
};

/// Draws one terrain. The same code for a window and off-screen; a context that prepare_gl has seen must be
/// current from its making to its end.
class Renderer {
  public:
    /// The terrain and the pyramid, which must be of the same data, must outlive the renderer. Fails where
    /// the coarsest of the ground cannot be read.
    static Result<Renderer> create(const lod::Terrain& terrain, const GroundData& ground);

    /// Hands the ground's shape to OpenGL; it is drawn until the next one comes.
    void upload(const DrawnGround& ground);

    /// Waits until all of the ground's texels that a picture's part wants are there. Fails where some are
    /// damaged.
    Result<void> complete(const lod::View& view, const DrawSettings& settings, const PicturePart& part);

    /// Pieces of the ground that the last picture wanted and that have not come yet: it was drawn with
    /// coarser ones in their places.
    std::size_t pending() const { return ground_->pending() + (overlays_ ? overlays_->pending() : 0); }

    /// Is there room for all of the ground's texels that a picture's part wants? Else it is drawn coarser.
    bool ground_fits(const lod::View& view, const DrawSettings& settings, const PicturePart& part);

    /// Draws the uploaded shape, which must have been made for this view, and sky. The ground's texels that
    /// are not there yet come in the background.
    /// \param measured  waits where it must to tell what was seen and how long the sea took
    Result<DrawFigures> draw(const lod::View& view, const DrawSettings& settings, const RenderTarget& target,
                             Region region, bool measured);
    Result<DrawFigures> draw(const lod::View& view, const DrawSettings& settings,
                             const RenderTarget& target) {
        return draw(view, settings, target, {}, false);
    }

    /// Draws, into what is current, what measures the sea instead of showing it (ocean/ocean_probe.hpp): (0,
    /// 0, 0, 1) where there is ground, Ocean::Look::probe where there is sea, no sky.
    Result<DrawFigures> probe(const lod::View& view, const DrawSettings& settings);

    /// Metres between the contours of the last picture; nothing where it had none.
    std::optional<double> contour_interval_m() const {
        return overlays_ ? overlays_->contour_interval_m() : std::nullopt;
    }

    /// The lines of the last picture's graticule, likewise.
    std::optional<Graticule> graticule() const { return overlays_ ? overlays_->graticule() : std::nullopt; }

    /// Of a file that overlays drape: what it has made and loaded so far. All 0 while it is off.
    OverlayDrawing::DrapeFigures drape_figures(int file) const {
        return overlays_ ? overlays_->figures(file) : OverlayDrawing::DrapeFigures{};
    }

    /// Of the quadtree's nodes in graphics memory.
    NodeBuffers::Figures node_figures() const { return nodes_ ? nodes_->figures() : NodeBuffers::Figures{}; }

    Ocean& ocean() { return *ocean_; }
    const Ocean& ocean() const { return *ocean_; }

  private:
    Renderer(const lod::Terrain& terrain, GroundTextures ground, const GroundData& data);

    /// What makes one terrain program differ from another.
    struct Variant {
        Layer layer;
        Shading shading;
        bool nodes, wireframe, sun_fixed, sky, ocean, probe;
        std::vector<DrawnOverlay> overlays;
        int areas;  ///< of the graticule
        friend auto operator<=>(const Variant&, const Variant&) = default;
    };
    Variant variant(const DrawSettings& settings) const;
    /// Makes what overlays need that were not drawn before, and lets go of what others had.
    Result<void> provide_overlays(const DrawSettings& settings);
    /// Sets what all of a part of a picture needs, and has its ground's texels come.
    void prepare(const lod::View& view, const DrawSettings& settings, const PicturePart& part);
    /// \return  draw calls: none where nothing was uploaded
    int draw_terrain(GlName program, const lod::View& view, const DrawSettings& settings);
    Result<GlName> terrain_program(const Variant& variant);
    Result<GlName> sky_program(bool low_sun);
    GlName ramp(const DrawSettings& settings);
    /// Nothing where no ground is under or over the eye.
    std::optional<bool> is_below_ground(const geo::Geodetic& eye, double exaggeration) const;
    /// The ocean's, where the eye is above the ground.
    Result<int> fill(const lod::View& view, const DrawSettings& settings);
    void make_vertex_array();

    const lod::Terrain* terrain_;
    std::unique_ptr<GroundTextures> ground_;  // the ocean keeps a pointer to it
    std::unique_ptr<Ocean> ocean_;
    std::map<Layer, GlTexture> ramps_;        // of layers that have been drawn
    std::shared_ptr<const HeightRamp> ramp_;  // that the tints have; null: their own
    std::optional<OverlayDrawing> overlays_;  // made with the first of them
    std::map<Variant, GlProgram> terrain_programs_;
    /// By day, and with a low sun, which is made when there is one.
    std::array<GlProgram, 2> sky_programs_;
    GroundData data_;
    std::optional<GroundCover> cover_;  // made with the layer's first picture
    GlBuffer frame_;
    GlBuffer vertices_;
    GlBuffer indices_;
    std::size_t vertex_bytes_ = 0;
    std::size_t index_bytes_ = 0;
    GlVertexArray vertex_array_;
    GlVertexArray no_vertices_;  // the sky's: core OpenGL draws nothing without one
    GlQuery seen_;
    int index_count_ = 0;
    std::optional<NodeBuffers> nodes_;  // while they are drawn, instead of the mesh
    float base_undulation_m_ = 0;       // of the sea's level, at the middle of the data
};

}  // namespace relevo::viewer
