#pragma once

#include "viewer/flight/flight_state.hpp"

namespace relevo::viewer {

/// Does what a key or a button asks for. \param width, height  of the window's picture
void obey(FlightState& flight, const Wish& wish, int width, int height);

}  // namespace relevo::viewer
