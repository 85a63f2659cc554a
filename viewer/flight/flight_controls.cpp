#define GLFW_INCLUDE_NONE  // keys alone
#include "viewer/flight/flight_controls.hpp"

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
           input.drag_right != glm::dvec2(0) || input.drag_middle != glm::dvec2(0);
}

bool FlightControls::toggle_following(const ViewState& view) {
    clearance_m_ = clearance_m_ ? std::nullopt : above_ground(view);
    return following();
}

void FlightControls::follow_ground(ViewState& view, double climbed_m, double dt) {
    const auto above = above_ground(view);
    if (!clearance_m_ || !above) return;
    *clearance_m_ = std::max(*clearance_m_ + climbed_m, kClearanceM);
    // Two thirds of the way in half a second: bumps are flown over, slopes are followed.
    view.H.m += (*clearance_m_ - *above) * (1 - std::exp(-dt / 0.5));
}

std::optional<geo::Ecef> FlightControls::ground_at(const lod::View& seen, const glm::dvec2& pixel,
                                                   double exaggeration) const {
    const glm::dvec3 ray = seen.ray(pixel);
    const auto hit = lod::pick(terrain_, seen.eye(), ray, exaggeration);
    if (!hit) return std::nullopt;
    return seen.eye() + hit->distance_m * ray;
}

Pose FlightControls::grabbed(const Pose& pose, const lod::View& seen, const glm::dvec2& cursor) const {
    // On the horizontal plane through what is held. Towards the horizon a pixel would be kilometres.
    const geo::EnuFrame local(geo::to_geodetic(*grabbed_));
    const glm::dvec3 ray = seen.ray(cursor);
    const double fall = -glm::dot(ray, local.up());
    constexpr double kFlattest = 0.03;
    if (fall < kFlattest) return pose;
    const glm::dvec3 to_grabbed = *grabbed_ - seen.eye();
    const glm::dvec3 under_cursor = ray * (-glm::dot(to_grabbed, local.up()) / fall);
    const glm::dvec3 way = to_grabbed - under_cursor;
    const double east = glm::dot(way, local.east());
    const double north = glm::dot(way, local.north());
    const double heading = pose.heading.radians();
    return moved(pose, east * std::sin(heading) + north * std::cos(heading),
                 east * std::cos(heading) - north * std::sin(heading), 0);
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

    const lod::View seen(camera_of(view, heights_, width, height));
    if (input.right_pressed_at) centre_ = ground_at(seen, *input.right_pressed_at, view.exaggeration);
    if (input.middle_pressed_at) grabbed_ = ground_at(seen, *input.middle_pressed_at, view.exaggeration);
    if (grabbed_ && input.drag_middle != glm::dvec2(0)) pose = grabbed(pose, seen, input.cursor);
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
    follow_ground(view, up, dt);
    keep_above_ground(view);
}

}  // namespace relevo::viewer
