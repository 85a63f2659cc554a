#include "viewer/flight/flight_state.hpp"

#include <filesystem>

namespace relevo::viewer {

FlightState::FlightState(Desk& at, const lod::Scene& over, const lod::Terrain& drawn_terrain,
                         const GroundData& drawn_ground, const EyeHeight& eye_heights, const ViewState& start,
                         const FlightOptions& asked)
    : desk(at),
      scene(over),
      terrain(drawn_terrain),
      ground(drawn_ground),
      heights(eye_heights),
      options(asked),
      view(start),
      motion(drawn_terrain, eye_heights, asked.forward_m_s),
      measuring(over, drawn_terrain, eye_heights),
      layers(ground, view.overlays, drawn_terrain.frame()) {
    panels.picture_marks = asked.picture_marks;
    if (asked.play) motion.play(*asked.play);
    if (!asked.record.empty()) recording.emplace(asked.record);
}

void FlightState::say(const std::string& line) {
    options.say(line);
    tell(line);
}

std::string FlightState::scene_name() const {
    std::error_code failed;
    return std::filesystem::absolute(scene.path(), failed).lexically_normal().string();
}

}  // namespace relevo::viewer
