#pragma once

#include <chrono>
#include <optional>

#include "viewer/flight/flight_controls.hpp"
#include "viewer/flight/flight_path.hpp"

namespace relevo::viewer {

/// What moves a view: its user, or a flight that is replayed until the user steers or presses a key.
class Motion {
  public:
    /// The terrain and heights must outlive it.
    Motion(const lod::Terrain& terrain, const EyeHeight& heights, double forward_m_s)
        : controls_(terrain, heights, forward_m_s) {}

    void play(FlightPath flight);
    /// A short flight between two views; at once where there is no clear way between them.
    void fly_to(ViewState& view, const ViewState& there);
    bool playing() const { return flight_.has_value(); }

    /// Changes the view for what happened in dt seconds. \param width, height  of the picture, pixels
    void move(ViewState& view, const Window& window, const Input& input, double dt, int width, int height);

    /// Is anything going on that changes the view without a new event?
    bool moving(const Window& window) const { return playing() || controls_.moving(window); }

    FlightControls& controls() { return controls_; }
    const FlightControls& controls() const { return controls_; }

  private:
    FlightControls controls_;
    std::optional<FlightPath> flight_;
    bool has_begun_ = false;  // with its first frame, however long that is in coming
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace relevo::viewer
