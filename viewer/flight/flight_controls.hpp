#pragma once

#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/input.hpp"
#include "viewer/pose.hpp"
#include "viewer/view_state.hpp"
#include "viewer/window.hpp"

namespace relevo::viewer {

/// Moves a view as keys and mouse say.
class FlightControls {
  public:
    /// The terrain and heights must outlive it.
    FlightControls(const lod::Terrain& terrain, const EyeHeight& heights, double forward_m_s)
        : terrain_(terrain), heights_(heights), forward_m_s_(forward_m_s) {}

    /// Changes the view for what happened in dt seconds. \param height  of the picture, pixels
    void steer(ViewState& view, const Window& window, const Input& input, double dt, int width, int height);

    /// Did the user steer or press a key?
    bool steered(const Window& window, const Input& input) const;

    /// Is anything going on that changes the view without a new event?
    bool moving(const Window& window) const;

    /// Of the keys, metres a second: grows with the height above the ground.
    double speed(const ViewState& view) const;
    /// Of the eye above the ground as it is drawn; nothing outside the data and over voids.
    std::optional<double> above_ground(const ViewState& view) const;

    /// Keeps the height above the ground, or lets go of it; says which. Off where there is no ground.
    bool toggle_following(const ViewState& view);
    bool following() const { return clearance_m_.has_value(); }

    /// The least height of the eye above the drawn ground, metres.
    static constexpr double kClearanceM = 2;

  private:
    bool keys_held(const Window& window) const;
    Pose pose_of(const ViewState& view) const;
    void put(ViewState& view, const Pose& pose) const;
    void keep_above_ground(ViewState& view) const;
    void follow_ground(ViewState& view, double climbed_m, double dt);
    /// Where the ray through a pixel meets the ground as far as it is in memory.
    std::optional<geo::Ecef> ground_at(const lod::View& seen, const glm::dvec2& pixel,
                                       double exaggeration) const;
    Pose grabbed(const Pose& pose, const lod::View& seen, const glm::dvec2& cursor) const;

    const lod::Terrain& terrain_;
    const EyeHeight& heights_;
    double forward_m_s_;
    double wheel_ = 0;
    std::optional<geo::Ecef> centre_;    // of going round
    std::optional<geo::Ecef> grabbed_;   // what moves with the cursor
    std::optional<double> clearance_m_;  // of following the ground
};

}  // namespace relevo::viewer
