#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "lod/soar/pick.hpp"
#include "lod/view.hpp"
#include "viewer/flight/flight_state.hpp"

// Going to places.
namespace relevo::viewer {

/// Towards what was clicked twice: a third of the way is left, or 50 m.
void go_near(FlightState& flight, const lod::View& view, const glm::dvec2& pixel, const lod::Hit& there);

/// To a place, in the middle of the picture and as far away as what is there now; or to a view. Asks where
/// there is no text.
void go_to(FlightState& flight, const std::string& text);

/// To a view as a string: how it is drawn changes at once, where the eye is by a short flight.
void go_to_view(FlightState& flight, const std::string& text);

/// Keeps the view among the settings' bookmarks.
void add_bookmark(FlightState& flight);

}  // namespace relevo::viewer
