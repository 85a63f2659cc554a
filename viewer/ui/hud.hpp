#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lod/measure/point.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/view.hpp"
#include "viewer/flight/flight_keys.hpp"
#include "viewer/marks/legend.hpp"
#include "viewer/marks/map_labels.hpp"
#include "viewer/ui/free_area.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// A tool of the tool bar, and whether it is the one in hand.
struct ToolButton {
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
    Covered covered;                 ///< by panels, in the last frame
    std::vector<ToolButton> tools;   ///< of the tool bar
    std::vector<std::string> facts;  ///< of the scene
    std::vector<MapLabel> labels;    ///< of contours and the graticule
    std::optional<Legend> legend;    ///< of the layer's colours
    std::vector<std::string> error;  ///< of the picture, measured
};

/// "H 4372.0 m above EGM96 (assumed)   h 4357.3 m": heights of a point with their datums, or why there are
/// none.
std::string heights_text(const lod::PointMeasurement& point, const lod::VerticalReference& vertical);
/// "37.577500° N  105.485300° W"
std::string place_text(geo::LatLon place);

/// A measured shape as it is drawn.
struct DrawnShape {
    std::vector<geo::Ecef> line;        ///< on the ground
    std::vector<std::size_t> vertices;  ///< which of them the user set
    std::string label;
    bool current = false;
};

/// Panels of text: the view, the place under the cursor, the keys, and what the picture is not. Gives what
/// they cover. \pre between Ui::begin and end
Covered draw_panels(const HudContent& content);

/// Drawn over the ground: compass, scale bar, measured shapes, a ring around a place of interest. \pre
/// between Ui::begin and end
void draw_marks(const HudContent& content, const std::vector<DrawnShape>& shapes,
                const std::optional<geo::Ecef>& pin, const lod::View& view);

}  // namespace relevo::viewer
