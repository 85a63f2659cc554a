#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/draw_settings.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ground/drape_textures.hpp"
#include "viewer/ground/height_code.hpp"
#include "viewer/overlay/graticule.hpp"
#include "viewer/overlay/ground_scale.hpp"
#include "viewer/overlay/overlay_block.hpp"

namespace relevo::viewer {

/// What makes the program of an overlay differ from that of another.
struct DrawnOverlay {
    Overlay::Kind kind;
    int file;
    friend auto operator<=>(const DrawnOverlay&, const DrawnOverlay&) = default;
};

/// Those of the settings that can be drawn: of imagery and vectors, whose file is there.
std::vector<DrawnOverlay> drawn_overlays(const DrawSettings& settings, std::size_t drapes);

/// What a program needs to draw these over the ground, or over the sea's water, on which there are no
/// contours: definitions of shaders/overlays.glsl.
/// \param drapes  files that are draped
/// \param areas   of the graticule (OverlayDrawing::areas)
enum class OverlaidSurface { ground, water };
std::string overlay_defines(const std::vector<DrawnOverlay>& overlays, std::size_t drapes, int areas,
                            OverlaidSurface surface = OverlaidSurface::ground);

/// What shaders/overlays.glsl reads. It is made for the first picture that has overlays.
class OverlayDrawing {
  public:
    /// \pre a context is current. The terrain must outlive this.
    OverlayDrawing(const lod::Terrain& terrain, const GroundData& data);

    /// Makes what the settings' files need, and lets go of what others had. Fails where one cannot be read.
    Result<void> provide(const DrawSettings& settings);

    /// Chooses intervals and lines for a view, and sets what the programs read. \pre provide
    void arrange(const lod::View& view, const DrawSettings& settings);

    /// Of the graticule that was arranged: 1, or more where several zones of UTM are in view; rounded up, so
    /// that there are few programs.
    int areas() const { return areas_; }

    /// What a part of the picture needs of what is draped comes in the background. \pre provide
    void update(const DrawSettings& settings, const Sight& sight);

    /// Waits for what is draped. \pre provide
    Result<void> complete(const DrawSettings& settings, const Sight& sight);

    /// Pages that the last picture wanted and that are not there yet.
    std::size_t pending() const;

    /// Is there room for all that is draped?
    bool fits(const DrawSettings& settings, const Sight& sight) const;

    /// Of each file, those made so far.
    struct DrapeFigures {
        std::uint64_t tiles = 0;
        int gl_objects = 0;
        std::size_t bytes = 0;
    };
    DrapeFigures figures(int file) const;

    /// Binds all to where the shader says.
    void bind() const;

    /// Of the last picture.
    std::optional<double> contour_interval_m() const { return contour_interval_m_; }
    const std::optional<Graticule>& graticule() const { return graticule_; }

  private:
    /// What the entry of a graticule of latitudes in a polar grid has.
    glm::vec2 arrange_graticule(const lod::View& view, bool utm, double pixel_m, OverlayBlock& block);

    const lod::Terrain* terrain_;
    GroundScale scale_;
    HeightCode code_;
    GlBuffer block_;
    GroundData data_;
    std::map<int, DrapeTextures> drapes_;  // by file; of those that are drawn
    std::vector<int> drawn_;               // files of the last picture
    int areas_ = 1;
    std::optional<double> contour_interval_m_;
    std::optional<Graticule> graticule_;
};

}  // namespace relevo::viewer
