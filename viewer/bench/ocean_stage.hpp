#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geo/result.hpp"
#include "lod/scene/scene.hpp"
#include "viewer/bench/ocean_row.hpp"
#include "viewer/bench/open_sea.hpp"
#include "viewer/camera.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/mesher.hpp"
#include "viewer/renderer.hpp"

namespace relevo::viewer {

/// From where, and how.
struct OceanSight {
    geo::LatLon place;
    geo::Degrees heading{60};
    double eye_m = 2;  ///< above sea level
    OceanGaze gaze = OceanGaze::horizon;
};

/// All that draws a scene's sea and judges what it drew, for one size of picture.
class OceanStage {
  public:
    /// What is referred to must outlive the stage.
    static Result<std::unique_ptr<OceanStage>> create(const lod::Scene& scene, const lod::Terrain& terrain,
                                                      const EyeHeight& heights, int width, int height);

    lod::Camera camera(const ViewState& state) const { return camera_of(state, heights_, width_, height_); }
    lod::Camera camera(const OceanSight& sight) const;

    Result<ProbePicture> probe(const lod::Camera& camera, const OceanSettings& settings);

    struct Times {
        OceanFigures figures;
        double cpu_ms = 0;  ///< medians
        double gpu_ms = 0;
    };
    Result<Times> time(const lod::Camera& camera, const OceanSettings& settings, int frames);

    /// Both, with all that can be told of a picture. \param frames  that are timed
    Result<OceanRow> measure(const OceanSight& sight, const OceanSettings& settings, int frames);

    /// For a mesh of one's own.
    Ocean& ocean() { return renderer_->ocean(); }
    /// What the sea that was drawn last ought to be. Known in deep water or, where the data has no bed,
    /// off shore: elsewhere what is drawn depends on how finely depths are read.
    const TrueSea& sea() const { return sea_; }
    std::vector<glm::ivec2> holes(const ProbePicture& picture) { return holes_.holes(picture); }

  private:
    OceanStage(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights,
               OffscreenContext context);

    Result<void> prepare(const lod::View& view, const DrawSettings& settings);
    double depth_m(geo::LatLon place);

    const lod::Terrain& terrain_;
    const EyeHeight& heights_;
    GroundFacts facts_;
    OffscreenContext context_;  // before all that OpenGL has
    std::optional<Renderer> renderer_;
    std::optional<OceanProbe> probe_;
    std::optional<RenderTarget> target_;
    Mesher mesher_;
    lod::TruePosts::Reader posts_{terrain_.posts()};
    OffShore off_shore_;
    std::shared_ptr<const lod::WaveMap> map_;  // what sea_ refers to
    TrueSea sea_;
    HoleFinder holes_;
    int width_ = 0;
    int height_ = 0;
};

/// In deeper water waves feel no bed: half the longest wave of a wind, or the middling one of a map.
double deep_water_m(const OceanSettings& settings);

}  // namespace relevo::viewer
