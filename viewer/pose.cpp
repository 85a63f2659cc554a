#include "viewer/pose.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relevo::viewer {

namespace {

geo::Degrees heading_of(const geo::EnuFrame& local, const glm::dvec3& direction) {
    return geo::wrapped_360(geo::Degrees::from_radians(
        std::atan2(glm::dot(direction, local.east()), glm::dot(direction, local.north()))));
}

/// A step short enough for the tangent plane: at 20 km the earth has fallen by 31 m, which the height then
/// corrects.
constexpr double kLongestStepM = 20e3;

Pose stepped(const Pose& pose, double ahead_m, double right_m, double up_m) {
    const geo::EnuFrame local(pose.eye);
    const double heading = pose.heading.radians();
    const glm::dvec3 ahead = std::sin(heading) * local.east() + std::cos(heading) * local.north();
    const glm::dvec3 right = std::cos(heading) * local.east() - std::sin(heading) * local.north();
    Pose there = pose;
    there.eye = geo::to_geodetic(local.origin() + (ahead_m * ahead + right_m * right));
    there.eye.h.m = pose.eye.h.m + up_m;
    // The direction in space stays; what it is called changes.
    there.heading = heading_of(geo::EnuFrame(there.eye), ahead);
    return there;
}

}  // namespace

Pose moved(const Pose& pose, double ahead_m, double right_m, double up_m) {
    const double way = std::hypot(ahead_m, right_m);
    // Nobody follows a longer way than half round the earth in one frame.
    const int steps = std::clamp(static_cast<int>(std::ceil(way / kLongestStepM)), 1, 1000);
    Pose there = pose;
    for (int i = 0; i < steps; ++i) there = stepped(there, ahead_m / steps, right_m / steps, up_m / steps);
    return there;
}

Pose turned(const Pose& pose, geo::Degrees right, geo::Degrees up) {
    Pose there = pose;
    there.heading = geo::wrapped_360(pose.heading + right);
    there.pitch.value = std::clamp(pose.pitch.value + up.value, -90.0, 90.0);
    return there;
}

Pose orbited(const Pose& pose, const geo::Ecef& centre, geo::Degrees round, geo::Degrees over) {
    const geo::EnuFrame there(geo::to_geodetic(centre));
    const glm::dvec3 offset = there.from_ecef(geo::to_ecef(pose.eye)).m;
    const double flat = std::hypot(offset.x, offset.y);
    const double distance = std::hypot(flat, offset.z);
    if (distance < 1e-3) return pose;
    const double elevation = std::atan2(offset.z, flat);
    const double azimuth = std::atan2(offset.x, offset.y) + round.radians();
    const double lifted = std::clamp(elevation + over.radians(), std::min(elevation, 0.0),
                                     std::max(elevation, geo::Degrees{89.9}.radians()));

    Pose moved_pose = pose;
    moved_pose.eye = geo::to_geodetic(
        there.to_ecef({distance * glm::dvec3(std::cos(lifted) * std::sin(azimuth),
                                             std::cos(lifted) * std::cos(azimuth), std::sin(lifted))}));
    // The head turns by the same angles, measured against the verticals of both places.
    const geo::EnuFrame before(pose.eye);
    const geo::EnuFrame after(moved_pose.eye);
    const auto towards = [&](const geo::EnuFrame& local) {
        const glm::dvec3 direction = centre - local.origin();
        return std::pair(
            heading_of(local, direction),
            geo::Degrees::from_radians(std::atan2(
                glm::dot(direction, local.up()),
                std::hypot(glm::dot(direction, local.east()), glm::dot(direction, local.north())))));
    };
    const auto [heading_before, pitch_before] = towards(before);
    const auto [heading_after, pitch_after] = towards(after);
    return turned(moved_pose, heading_after - heading_before, pitch_after - pitch_before);
}

}  // namespace relevo::viewer
