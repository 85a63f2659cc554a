#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/ocean/ocean_mesh.hpp"
#include "lod/ocean/sea_spacing.hpp"
#include "lod/ocean/wave_map_error.hpp"
#include "lod/ocean/waves.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ground/ground_textures.hpp"
#include "viewer/ocean/mesh_buffers.hpp"
#include "viewer/ocean/ocean_settings.hpp"
#include "viewer/ocean/ripples.hpp"
#include "viewer/ocean/water_pages.hpp"
#include "viewer/ocean/wave_map_texture.hpp"
#include "viewer/sun_setting.hpp"

namespace relevo::viewer {

/// What of the sea a picture drew; all 0 where there is none in view.
struct OceanFigures {
    OceanKind kind = OceanKind::off;  ///< that was drawn, never automatic
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    int draw_calls = 0;
    double arrange_ms = 0;  ///< of the processor, to choose what is drawn
    double draw_ms = 0;     ///< to its last pixel; only where it is asked for

    void add(const OceanFigures& other);
};

/// Draws a scene's sea: one mesh of three, waves, water. Makes nothing in OpenGL before there is sea in view.
class Ocean {
  public:
    /// What is referred to must outlive the ocean. \param heights  null: the sea is at the ellipsoid
    Ocean(const lod::Terrain& terrain, const GroundTextures& ground, const EyeHeight* heights);

    struct Look {
        SunSetting sun;
        bool sky = true;       ///< haze in the distance
        bool low_sun = false;  ///< it mirrors a sky of dusk or night
        /// Instead of colours: place in the chart from the nadir, height of the waves, 2.
        bool probe = false;
        /// Of what is drawn over the water (overlay_defines), which is bound; empty: nothing.
        std::string overlays = {};
    };
    /// Draws what of the sea is in view into what is current, with depth. \pre the frame's uniforms are bound
    Result<OceanFigures> draw(const lod::View& view, const OceanSettings& settings, const Look& look);

    /// Draws water into what neither the sea nor the ground has been drawn into, but the data has one of
    /// them: at the waterline each is asked about the place that it has itself on a ray, and both may say
    /// that it is the other's. To be called after the ground has been drawn. \return draw calls
    Result<int> fill();

    /// The wind's waves in the last picture, where it had no map, and the chart that its probe speaks of.
    const lod::Waves& waves() const { return waves_; }
    const std::optional<lod::SeaChart>& chart() const { return chart_; }

    /// A mesh instead of the ones that a view chooses, for measuring.
    void use_mesh(OceanKind kind, std::unique_ptr<lod::OceanMesh> mesh);

  private:
    struct Variant {
        OceanKind kind;
        bool shore, sky, low_sun, probe, map, fill;
        std::string overlays;
        friend auto operator<=>(const Variant&, const Variant&) = default;
    };

    lod::Water water_in(const lod::SeaView& sea, const glm::dvec2& centre, double radius_m) const;
    void update_water();
    void update_waves(const OceanSettings& settings);
    double crest_m() const { return map_ ? map_->crest_m() : waves_.crest_m(); }
    lod::SeaSpacing spacing(const lod::View& view, double error_px) const;
    void update_undulation(const lod::SeaView& sea, double sea_h_m);
    double sea_height(geo::LatLon place) const;
    double wave_height(const glm::dvec2& at, double time_s) const;
    const lod::OceanMesh& mesh(OceanKind kind);
    MeshBuffers& buffers(OceanKind kind);
    /// Makes a mesh's copies, and all that its programs read, what is drawn from.
    MeshBuffers& bind(OceanKind kind, const lod::OceanPicture& picture);
    Result<GlName> program(const Variant& variant);
    void make_objects();
    void bake_ripples(double time_s);

    const lod::Terrain* terrain_;
    const GroundTextures* ground_;
    const EyeHeight* heights_;
    geo::LatLon middle_;
    WaterPages water_;
    std::vector<PageTable::Resident> water_of_;  // what `water_` was made of

    std::optional<lod::Wind> wind_;
    lod::Waves waves_;
    std::shared_ptr<const lod::WaveMap> map_;  // instead of them
    std::optional<lod::WaveMapError> map_error_;
    std::optional<WaveMapTexture> map_texture_;
    std::optional<Ripples> ripples_;
    double ripples_time_s_ = 0;
    bool ripples_baked_ = false;
    std::optional<lod::SeaChart> chart_;

    // `off` is the flat grid of `fill`.
    std::map<OceanKind, std::unique_ptr<lod::OceanMesh>> meshes_;
    std::map<OceanKind, MeshBuffers> buffers_;
    std::map<Variant, GlProgram> programs_;
    /// Of the last picture, for `fill`.
    struct {
        Variant variant;
        bool shore = false;  // was there any?
        lod::OceanPicture flat;
    } last_;
    GlBuffer block_, mesh_block_;
    GlTexture undulation_, ripple_tiles_;
};

/// The mesh that `automatic` stands for: the projected grid wherever it keeps to the spacing, for it spends
/// vertices where pixels are; along the horizon, low over the sea, where its rows are too far apart, the
/// radial one, which needs fewer vertices than the geoclipmap (docs/ocean.md has the table).
OceanKind chosen(OceanKind kind, const lod::SeaView& sea, const lod::SeaSpacing& spacing);

}  // namespace relevo::viewer
