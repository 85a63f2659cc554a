#pragma once

#include <array>

#include "viewer/flight/flight_keys.hpp"
#include "viewer/measure/measure_tool.hpp"

namespace relevo::viewer {

/// A tool as its user meets it.
struct ToolChoice {
    Command command;
    Tool tool;
    const char* name;
    const char* what;
};

inline constexpr std::array<ToolChoice, 6> kTools{
    {{Command::tool_point, Tool::point, "Point", "What is known of a place (F2)"},
     {Command::tool_line, Tool::line, "Line", "Distance and profile between two places (F3)"},
     {Command::tool_path, Tool::path, "Path", "Over many places; Enter ends it (F4)"},
     {Command::tool_area, Tool::area, "Area", "Area and volume; Enter ends it (F5)"},
     {Command::tool_sight, Tool::sight, "Sight", "Is one place seen from another? (F6)"},
     {Command::tool_viewshed, Tool::viewshed, "Viewshed", "What is seen from a place? (F7)"}}};

}  // namespace relevo::viewer
