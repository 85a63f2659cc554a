#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "geo/result.hpp"
#include "lod/lstr/chunk_mesher.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/flight_path.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/marks.hpp"
#include "viewer/measuring.hpp"
#include "viewer/ocean/ocean.hpp"
#include "viewer/ui/desk.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

struct FlightOptions {
    int samples = 0;                      ///< 1, 4 or 8 a pixel; 0: 4, or 1 where OpenGL runs in software
    double forward_m_s = 0;               ///< flies ahead by itself until a key is pressed
    std::uint64_t frames = 0;             ///< closes after so many; 0: when the user does
    std::optional<FlightPath> play = {};  ///< replayed until it ends or the user steers or presses a key
    std::filesystem::path record = {};    ///< where what is flown is written in the end; empty: nowhere
    lod::ChunkOptions chunks = {};        ///< how nodes are kept and loaded, with Method::lstr
    Marks picture_marks = {};             ///< of large pictures, at first
    BudgetLimits budget = {};             ///< where it has limits, tau adapts to them
    MeasurementFiles files = {};          ///< how measurements are kept
    std::filesystem::path output_folder = ".";  ///< of pictures, flights and measurements
    /// Called with each line that the user asked for: copied coordinates, copied views, screenshots.
    std::function<void(const std::string&)> say = [](const std::string&) {};
    /// Asked before each frame, twice a second at rest: is the window to be closed?
    std::function<bool()> must_close = [] { return false; };
};

struct FlightFigures {
    std::uint64_t frames = 0;
    double frame_ms_median =
        0;                    ///< refinement, upload, drawing, read-out and showing; without the first frame,
    double frame_ms_p99 = 0;  ///< which compiles the programs
    double refine_ms_median = 0;
    std::uint64_t triangles = 0;  ///< of the last frame
    int draw_calls = 0;           ///< of the last frame, without the read-out's
    OceanFigures ocean;           ///< of the last frame
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
