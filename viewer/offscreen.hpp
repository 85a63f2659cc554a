#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/oracle.hpp"
#include "lod/terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/gl/gl_context_egl.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/marks/marks.hpp"
#include "viewer/mesher.hpp"
#include "viewer/ocean/ocean.hpp"
#include "viewer/overlay/overlay_figures.hpp"
#include "viewer/picture.hpp"
#include "viewer/renderer.hpp"
#include "viewer/ui/picture_marks.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

struct PictureRequest {
    int width = 1280;  ///< 1 to kLargestPicture
    int height = 720;
    int samples = 4;                                      ///< 1, 4 or 8 a pixel
    std::optional<std::array<float, 3>> background = {};  ///< flat, 0 to 1, instead of sky and haze
    bool measure_error = false;
    bool timed = true;  ///< all is made and compiled before it is drawn, so that the figures have times
    std::optional<std::uint64_t> max_triangles =
        {};  ///< tau grows, up to FrameBudget's coarsest, to keep to it
    /// Drawn once over the whole picture, as large as it is (marks_scale). \pre where there are any, the
    /// picture is at least kLeastMarkedWidth x kLeastMarkedHeight
    Marks marks = {};
};
inline constexpr int kLargestPicture = 16384;

struct PictureFigures {
    std::uint64_t triangles = 0;
    double tau_reached_px = 0;  ///< the view's own unless max_triangles made it grow
    int draw_calls = 0;
    double refine_ms = 0;  ///< of the mesh, buffers warm
    double frame_ms =
        0;  ///< refinement, upload and drawing to the last pixel, programs compiled, ground loaded
    std::optional<lod::MeasuredError> error;  ///< only where asked for and something is in view
    OceanFigures ocean;                       ///< of all parts that the picture was drawn in
    std::string gl;                           ///< what drew
    std::vector<OverlayFigures> overlays;
};

struct FinishedPicture {
    Picture picture;
    PictureFigures figures;
};

/// Draws views off-screen.
class OffscreenPainter {
  public:
    /// In an OpenGL context of its own, which is current while it lives. All must outlive it.
    static Result<OffscreenPainter> create(const lod::Terrain& terrain, const GroundData& ground,
                                           const EyeHeight& heights);
    /// In the context that is current, and stays so.
    static Result<OffscreenPainter> create_here(const lod::Terrain& terrain, const GroundData& ground,
                                                const EyeHeight& heights);

    /// Draws one view, whole or not at all: waits for all of the ground that it wants, and fails where some
    /// of that is damaged, where OpenGL reports an error, or where ground that is in view left no pixel. A
    /// picture of any size is drawn in tiles of bounded memory.
    Result<FinishedPicture> draw(const ViewState& view, const PictureRequest& request);

  private:
    OffscreenPainter(std::optional<OffscreenContext> context, Renderer renderer, const lod::Terrain& terrain,
                     const GroundFacts& facts, const EyeHeight& heights);
    Result<void> add_marks(const lod::View& view, const ViewState& state, const Marks& marks,
                           Picture& picture);

    std::optional<OffscreenContext> context_;  // goes last
    Renderer renderer_;
    std::unique_ptr<Mesher> mesher_;
    const lod::Terrain& terrain_;
    GroundFacts facts_;
    const EyeHeight& heights_;
    std::optional<PictureMarks> marks_;  // of the last scale
};

/// One picture by a painter of its own.
Result<FinishedPicture> draw_picture(const lod::Terrain& terrain, const GroundData& ground,
                                     const EyeHeight& heights, const ViewState& view,
                                     const PictureRequest& request);

/// Is there ground in view that must have left pixels? It is asked of the full data, by rays: one counts
/// where its neighbours as far away as the mesh may be wrong hit the ground too.
bool ground_must_show(const lod::Terrain& terrain, const lod::View& view, const ViewState& state);

}  // namespace relevo::viewer
