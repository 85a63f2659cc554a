#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lod/measure/point.hpp"
#include "lod/mesh.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/flight/flight_options.hpp"
#include "viewer/flight/ground_layers.hpp"
#include "viewer/flight/motion.hpp"
#include "viewer/flight/recording.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/measure/error_probe.hpp"
#include "viewer/measure/measuring.hpp"
#include "viewer/ui/desk.hpp"
#include "viewer/ui/panels.hpp"

namespace relevo::viewer {

/// What a flight is over and what its user changes: frames show it, commands change it.
struct FlightState {
    /// All must outlive it.
    FlightState(Desk& at, const lod::Scene& over, const lod::Terrain& drawn_terrain,
                const GroundData& drawn_ground, const EyeHeight& eye_heights, const ViewState& start,
                const FlightOptions& asked);

    Desk& desk;
    const lod::Scene& scene;
    const lod::Terrain& terrain;
    GroundData ground;  ///< layers change it
    const EyeHeight& heights;
    const FlightOptions& options;

    ViewState view;
    Motion motion;
    Measuring measuring;
    GroundLayers layers;
    Panels panels;
    Panels::KeyFrames key_frames;
    ErrorProbe error;
    std::optional<Recording> recording;
    bool hidden = false;             ///< panels and read-outs
    bool screenshot_wanted = false;  ///< of this frame

    // Of the last frame.
    std::function<const lod::Mesh&()> mesh;  ///< made when it is asked for
    std::optional<lod::View> drawn;
    std::optional<lod::PointMeasurement> cursor;  ///< on the ground
    std::optional<double> middle_distance_m;      ///< to the ground in the middle of the picture

    void tell(std::string message) { desk.tell(std::move(message)); }
    /// What the user asked for: printed, and shown for a while.
    void say(const std::string& line);
    /// As settings name the scene.
    std::string scene_name() const;
};

}  // namespace relevo::viewer
