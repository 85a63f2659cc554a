#pragma once

#include <filesystem>

#include "geo/result.hpp"
#include "viewer/flight/flight_state.hpp"

// What a flight writes into the output folder and reads from files.
namespace relevo::viewer {

/// The window's picture as it is about to be shown.
Result<void> take_screenshot(FlightState& flight);

/// Four times as wide and as high as the window, without read-outs, as `render` draws it.
/// \param width, height  of the window's picture
void take_large_picture(FlightState& flight, int width, int height);

void toggle_recording(FlightState& flight);
/// Writes what was flown, where it is being recorded.
Result<void> end_recording(FlightState& flight);

/// Writes the key frames as a flight, and flies it.
void play_key_frames(FlightState& flight);

void save_measurements(FlightState& flight);
/// The current shape's, as `relevo measure viewshed` writes it.
void save_viewshed(FlightState& flight);

/// What a user expects of a file that was dropped or chosen, by what it holds: heights become a scene,
/// pictures and lines lie over the ground, measurements are measured. Asks where it may be several.
void open_path(FlightState& flight, const std::filesystem::path& path);
void open_as(FlightState& flight, const std::filesystem::path& path, FileUse use);

}  // namespace relevo::viewer
