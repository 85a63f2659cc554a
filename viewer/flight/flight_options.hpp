#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lod/lstr/chunk_mesher.hpp"
#include "viewer/flight/flight_path.hpp"
#include "viewer/flight/layer_files.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/marks/marks.hpp"
#include "viewer/measure/measuring.hpp"

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
    LayerFiles layers = {};               ///< what else can be opened
    std::filesystem::path output_folder = ".";  ///< of pictures, flights and measurements
    /// Called with each line that the user asked for: copied coordinates, copied views, screenshots.
    std::function<void(const std::string&)> say = [](const std::string&) {};
    /// Asked before each frame, twice a second at rest: is the window to be closed?
    std::function<bool()> must_close = [] { return false; };
};

}  // namespace relevo::viewer
