#pragma once

#include <optional>
#include <vector>

#include "viewer/flight/flight_path.hpp"

namespace relevo::viewer {

/// Makes keys of what a user flies: one every kStepS while the camera moves, none while it rests. Rests last
/// as long as they did.
class FlightRecorder {
  public:
    static constexpr double kStepS = 0.1;

    /// To be told the view of each frame. \param time_s  since the flight began, growing
    void see(const ViewState& view, double time_s);

    /// Was it told any view?
    bool any() const { return !keys_.empty(); }

    /// What was flown, rounded to below what a camera shows (1e-8 degrees of the place, 1 mm of height, 1e-4
    /// degrees of the others). \pre at least one view was seen
    FlightPath finish() const;

  private:
    std::vector<FlightKey> keys_;
    std::optional<FlightKey> last_;  // seen, and not yet a key
};

}  // namespace relevo::viewer
