#pragma once

#include <glm/vec2.hpp>

#include "geo/position.hpp"

namespace relevo::viewer {

/// Where a camera is and where it looks. Kept in geodetic coordinates in double: it moves as well at 2 m
/// above the ground as at 10 000 km, at the antimeridian and near the poles.
struct Pose {
    geo::Geodetic eye;
    geo::Degrees heading;  ///< clockwise from north, in [0, 360)
    geo::Degrees pitch;    ///< in [-90, 90]
    geo::Degrees roll;
};

/// Moves along the ground's curve, ahead and to the right of the heading, and up, in metres. Straight ahead
/// is a geodesic: the heading turns as meridians do, and a flight over a pole comes down on its other side.
Pose moved(const Pose& pose, double ahead_m, double right_m, double up_m);

/// Turns the head: to the right, and up. Looking straight up or down is as far as it goes.
Pose turned(const Pose& pose, geo::Degrees right, geo::Degrees up);

/// Goes round a point, which keeps its distance and, but for a change of roll that is left out, its place in
/// the picture. `round` is clockwise seen from above; `over` lifts the eye, to no more than straight above
/// the point and no less than level with it.
Pose orbited(const Pose& pose, const geo::Ecef& centre, geo::Degrees round, geo::Degrees over);

}  // namespace relevo::viewer
