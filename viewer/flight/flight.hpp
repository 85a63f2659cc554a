#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/flight/flight_options.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/ocean/ocean.hpp"
#include "viewer/overlay/overlay_figures.hpp"
#include "viewer/ui/desk.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

struct FlightFigures {
    std::uint64_t frames = 0;
    double frame_ms_median =
        0;                    ///< refinement, upload, drawing, read-out and showing; without the first frame,
    double frame_ms_p99 = 0;  ///< which compiles the programs
    double refine_ms_median = 0;
    std::uint64_t triangles = 0;           ///< of the last frame
    int draw_calls = 0;                    ///< of the last frame, without the read-out's
    OceanFigures ocean;                    ///< of the last frame
    std::vector<OverlayFigures> overlays;  ///< of the last frame
    GlCounts gl_objects{};                 ///< when it ended
    int width = 0;
    int height = 0;
    int samples = 1;
    std::string gl;
    ViewState view;                              ///< of the last frame
    double tau_reached_px = 0;                   ///< of the last frame: the view's own unless a budget acts
    std::optional<double> frames_within_budget;  ///< part of the frames that kept to it, 0 to 1
};

/// Shows a scene and returns when the window is closed, or when the desk has another one to open.
Result<FlightFigures> fly(Desk& desk, const lod::Scene& scene, const lod::Terrain& terrain,
                          const GroundData& ground, const EyeHeight& heights, const ViewState& start,
                          const FlightOptions& options);

}  // namespace relevo::viewer
