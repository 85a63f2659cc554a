#pragma once

#include <span>
#include <vector>

#include "geo/position.hpp"

namespace relevo::geo {

/// The parts of a geodesic path on either side of the antimeridian, as RFC 7946 (section 3.1.9) wants them in
/// a file: longitudes in [-180, 180], and where the path crosses the antimeridian one part ends and the next
/// begins, at the latitude of the geodesic there. One part, and no new vertex, where it does not cross it.
/// Own vertices keep their bits (lon to a whole turn).
std::vector<std::vector<LatLon>> split_path(std::span<const LatLon> path);

/// The same of a polygon with geodesic sides (the smaller part of the earth within it): rings that are not
/// closed, counter-clockwise as RFC 7946 (3.1.6) wants. A polygon with a pole in it runs along the
/// antimeridian to the pole and back. \pre at least 3 corners; sides do not cross
std::vector<std::vector<LatLon>> split_polygon(std::span<const LatLon> polygon);

}  // namespace relevo::geo
