#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "geo/result.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

struct FlightOptions {
    int width = 1280;
    int height = 720;
    int samples = 0;           ///< 1, 4 or 8 a pixel; 0: 4, or 1 where OpenGL runs in software
    double forward_m_s = 0;    ///< flies ahead by itself until a key is pressed
    std::uint64_t frames = 0;  ///< closes after so many; 0: when the user does
    double ui_scale = 0;       ///< of letters and marks; 0: what the screen says
    std::filesystem::path screenshot_folder = ".";
    /// Called with each line that the user asked for: copied coordinates, copied views, screenshots.
    std::function<void(const std::string&)> say = [](const std::string&) {};
};

struct FlightFigures {
    std::uint64_t frames = 0;
    double frame_ms_median =
        0;                    ///< refinement, upload, drawing, read-out and showing; without the first frame,
    double frame_ms_p99 = 0;  ///< which compiles the programs
    double refine_ms_median = 0;
    std::uint64_t triangles = 0;  ///< of the last frame
    int draw_calls = 0;           ///< of the last frame, without the read-out's
    int width = 0;
    int height = 0;
    int samples = 1;
    std::string gl;
    ViewState view;  ///< of the last frame
};

/// Opens a window on a scene and returns when it is closed.
Result<FlightFigures> fly(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights,
                          const ViewState& start, const FlightOptions& options);

}  // namespace relevo::viewer
