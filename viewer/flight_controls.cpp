#define GLFW_INCLUDE_NONE  // keys alone
#include "viewer/flight_controls.hpp"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>

#include "lod/soar/pick.hpp"
#include "viewer/camera.hpp"

namespace relevo::viewer {

namespace {

/// +1, 0 or -1 for a pair of keys, either of which may have a second one.
double axis(const Window& window, int plus, int plus_too, int minus, int minus_too) {
    const bool forth = window.held(plus) || window.held(plus_too);
    const bool back = window.held(minus) || window.held(minus_too);
    return static_cast<double>(forth) - static_cast<double>(back);
}

double ahead_axis(const Window& window) {
    return axis(window, GLFW_KEY_W, GLFW_KEY_UP, GLFW_KEY_S, GLFW_KEY_DOWN);
}
double right_axis(const Window& window) {
    return axis(window, GLFW_KEY_D, GLFW_KEY_D, GLFW_KEY_A, GLFW_KEY_A);
}
double up_axis(const Window& window) {
    return axis(window, GLFW_KEY_E, GLFW_KEY_PAGE_UP, GLFW_KEY_Q, GLFW_KEY_PAGE_DOWN);
}
double turn_axis(const Window& window) {
    return axis(window, GLFW_KEY_RIGHT, GLFW_KEY_RIGHT, GLFW_KEY_LEFT, GLFW_KEY_LEFT);
}

constexpr double kTurnDegreesPerS = 60;
constexpr double kOrbitDegreesPerPx = 0.3;

}  // namespace

Pose FlightControls::pose_of(const ViewState& view) const {
    return {camera_of(view, heights_, 1, 1).eye, view.heading, view.pitch, view.roll};
}

void FlightControls::put(ViewState& view, const Pose& pose) const {
    set_eye(view, heights_, pose.eye);
    view.heading = pose.heading;
    view.pitch = pose.pitch;
    view.roll = pose.roll;
}

std::optional<double> FlightControls::above_ground(const ViewState& view) const {
    const auto ground = ground_height(terrain_, view.place, view.exaggeration);
    if (!ground) return std::nullopt;
    return view.H.m + heights_.undulation(view.place).m - ground->m;
}

double FlightControls::speed(const ViewState& view) const {
    // Over voids and beside the data the height above the datum has to do.
    const double above = std::abs(above_ground(view).value_or(view.H.m));
    return 0.4 * std::clamp(above, 10.0, 1e7) * std::pow(1.25, wheel_);
}

bool FlightControls::moving(const Window& window) const {
    return forward_m_s_ != 0 || keys_held(window);
}

bool FlightControls::keys_held(const Window& window) const {
    return ahead_axis(window) != 0 || right_axis(window) != 0 || up_axis(window) != 0 ||
           turn_axis(window) != 0;
}

bool FlightControls::steered(const Window& window, const Input& input) const {
    return keys_held(window) || !input.pressed.empty() || input.drag_left != glm::dvec2(0) ||
           input.drag_right != glm::dvec2(0);
}

void FlightControls::keep_above_ground(ViewState& view) const {
    const auto above = above_ground(view);
    if (above && *above < kClearanceM) view.H.m += kClearanceM - *above;
}

void FlightControls::steer(ViewState& view, const Window& window, const Input& input, double dt, int width,
                           int height) {
    if (!input.pressed.empty()) forward_m_s_ = 0;
    wheel_ = std::clamp(wheel_ + input.wheel, -40.0, 40.0);
    const Pose before = pose_of(view);
    Pose pose = before;

    // Looking around: what the cursor holds stays under it.
    const double degrees_per_px = view.fov.value / height;
    pose = turned(
        pose, geo::Degrees{-input.drag_left.x * degrees_per_px + turn_axis(window) * kTurnDegreesPerS * dt},
        geo::Degrees{input.drag_left.y * degrees_per_px});

    if (input.right_pressed_at) {
        const lod::View seen(camera_of(view, heights_, width, height));
        const glm::dvec3 ray = seen.ray(*input.right_pressed_at);
        const auto hit = lod::pick(terrain_, seen.eye(), ray, view.exaggeration);
        centre_.reset();
        if (hit) centre_ = seen.eye() + hit->distance_m * ray;
    }
    if (centre_ && input.drag_right != glm::dvec2(0)) {
        pose = orbited(pose, *centre_, geo::Degrees{input.drag_right.x * kOrbitDegreesPerPx},
                       geo::Degrees{input.drag_right.y * kOrbitDegreesPerPx});
    }

    const bool hurry = window.held(GLFW_KEY_LEFT_SHIFT) || window.held(GLFW_KEY_RIGHT_SHIFT);
    const double way = speed(view) * (hurry ? 4 : 1) * dt;
    const double ahead = way * ahead_axis(window) + forward_m_s_ * dt;
    const double right = way * right_axis(window);
    const double up = way * up_axis(window);
    if (ahead != 0 || right != 0 || up != 0) pose = moved(pose, ahead, right, up);

    const bool changed = pose.eye.lat != before.eye.lat || pose.eye.lon != before.eye.lon ||
                         pose.eye.h != before.eye.h || pose.heading != before.heading ||
                         pose.pitch != before.pitch;
    if (changed) put(view, pose);
    keep_above_ground(view);
}

}  // namespace relevo::viewer
