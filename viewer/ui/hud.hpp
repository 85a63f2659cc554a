#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lod/measure/point.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/view.hpp"
#include "viewer/flight_keys.hpp"
#include "viewer/ruler.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// A tool of the tool bar, and whether it is the one in hand.
struct Tool {
    const char* name;
    Command command;
    const char* what;
    bool on;
};

/// What the read-out says.
struct HudContent {
    ViewState view;
    const lod::VerticalReference* vertical = nullptr;
    std::optional<lod::PointMeasurement> cursor;  ///< nothing: no ground there
    std::optional<double> above_ground_m;         ///< of the eye
    double speed_m_s = 0;
    std::uint64_t triangles = 0;
    std::optional<double> tau_reached_px;  ///< where it is not the view's
    std::string_view tau_limit;            ///< what makes it so
    bool playing = false;                  ///< a recorded flight
    bool recording = false;
    bool following = false;  ///< the ground
    double frame_ms = 0;
    std::size_t pending = 0;  ///< pieces of the ground that are being loaded
    std::optional<double>
        middle_distance_m;           ///< to the ground in the middle of the picture, for the scale bar
    std::string message;             ///< what was just done
    bool cursor_is_preview = false;  ///< of the place: finer ground is being read
    bool keys_shown = false;
    float panel_width = 0;           ///< what the side panel covers, in the user interface's units
    std::vector<Tool> tools;         ///< of the tool bar
    std::vector<std::string> facts;  ///< of the scene
    std::vector<std::string> error;  ///< of the picture, measured
};

/// "H 4372.0 m above EGM96 (assumed)   h 4357.3 m": heights of a point with their datums, or why there are
/// none.
std::string heights_text(const lod::PointMeasurement& point, const lod::VerticalReference& vertical);
/// "37.577500° N  105.485300° W"
std::string place_text(geo::LatLon place);
/// "12.345 km", "840.00 m"
std::string length_text(double metres);

/// Panels of text: the view, the place under the cursor, the measured line, the keys. \pre between Ui::begin
/// and end
void draw_panels(const HudContent& content, const Ruler& ruler);

/// Drawn over the ground: compass, scale bar, the ruler's marks and line. \pre between Ui::begin and end
void draw_marks(const HudContent& content, const Ruler& ruler, const std::vector<geo::Ecef>& ruler_line,
                const lod::View& view);

}  // namespace relevo::viewer
