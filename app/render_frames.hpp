#pragma once

#include <functional>
#include <string>

#include "geo/result.hpp"
#include "viewer/flight/flight_path.hpp"
#include "viewer/offscreen.hpp"

namespace relevo::app {

/// The frames of a flight as pictures.
struct FrameRequest {
    std::string pattern;  ///< of the files' names, with one %d, %5d or %05d in it
    viewer::FlightPath flight;
    double fps = 30;
    viewer::ViewState view;  ///< how it is drawn; where from is the flight's
    viewer::PictureRequest picture;
    /// What each picture says of itself.
    std::function<viewer::PictureNotes(const viewer::ViewState&)> notes;
};

/// A file's name: the number in the pattern's place. Fails with ErrorKind::usage where the pattern has no
/// place for it, or several.
Result<std::string> frame_name(const std::string& pattern, int number);

/// Draws the frames that are not there yet, numbered from 0. Gives how many the flight has.
Result<int> render_frames(const FrameRequest& request, viewer::OffscreenPainter& painter,
                          const std::function<void(double)>& progress);

}  // namespace relevo::app
