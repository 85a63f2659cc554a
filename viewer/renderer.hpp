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
#include "viewer/gl_object.hpp"
#include "viewer/layer.hpp"
#include "viewer/render_target.hpp"
#include "viewer/sun_setting.hpp"
#include "viewer/terrain_textures.hpp"

namespace relevo::viewer {

/// How the ground is drawn.
struct DrawSettings {
    Layer layer = Layer::hypsometric;
    bool wireframe = false;
    double exaggeration = 1;
    SunSetting sun = {};
    /// A flat colour, 0 to 1, instead of sky, horizon and haze.
    std::optional<std::array<float, 3>> background = {};
};

/// The part of a view's picture that a target shows: pixels from the upper left corner.
struct Region {
    int x = 0;
    int y = 0;
};

struct DrawFigures {
    int draw_calls = 0;
    /// Did any sample of the ground pass? Asked for only where `draw` is told to count.
    bool terrain_seen = false;
};

/// Draws one terrain. The same code for a window and off-screen; a context that prepare_gl has seen must be
/// current from its making to its end.
class Renderer {
  public:
    /// The terrain must outlive the renderer.
    static Result<Renderer> create(const lod::Terrain& terrain);

    /// Hands a mesh to OpenGL; it is drawn until the next one comes.
    void upload(const lod::Mesh& mesh);

    /// Draws the uploaded mesh, which must have been made for this view, and sky.
    Result<DrawFigures> draw(const lod::View& view, const DrawSettings& settings, const RenderTarget& target,
                             Region region, bool count_terrain);
    Result<DrawFigures> draw(const lod::View& view, const DrawSettings& settings,
                             const RenderTarget& target) {
        return draw(view, settings, target, {}, false);
    }

  private:
    explicit Renderer(const lod::Terrain& terrain) : terrain_(&terrain) {}

    /// What makes one terrain program differ from another.
    struct Variant {
        Layer layer;
        bool wireframe, sun_fixed, sky;
        friend auto operator<=>(const Variant&, const Variant&) = default;
    };
    Result<GlName> terrain_program(const Variant& variant);
    Result<void> make_ramps();
    void make_vertex_array();

    const lod::Terrain* terrain_;
    TerrainTextures textures_;
    std::array<GlTexture, 2> ramps_;  // hypsometric, slope
    std::map<Variant, GlProgram> terrain_programs_;
    GlProgram sky_program_;
    GlBuffer frame_;
    GlBuffer vertices_;
    GlBuffer indices_;
    std::size_t vertex_bytes_ = 0;
    std::size_t index_bytes_ = 0;
    GlVertexArray vertex_array_;
    GlVertexArray no_vertices_;  // the sky's: core OpenGL draws nothing without one
    GlQuery seen_;
    int index_count_ = 0;
    float base_undulation_m_ = 0;  // of the sea's level, at the middle of the data
};

}  // namespace relevo::viewer
