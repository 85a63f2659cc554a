#include "geo/frame.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geo/ellipsoid.hpp"

namespace relevo::geo {

LatLon GridFrame::lat_lon(GridPosition place) const {
    // Clamped: rounding at a pole's row, and padding beyond it, must not make a latitude that is none.
    return {Degrees{std::clamp(north - place.row * step_y, -90.0, 90.0)},
            Degrees{west + place.column * step_x}};
}

GridPosition GridFrame::grid_position(LatLon place) const {
    const double middle = 0.5 * (columns - 1);
    const double from_middle = std::remainder(place.lon.value - (west + middle * step_x), 360.0);
    return {middle + from_middle / step_x, (north - place.lat.value) / step_y};
}

Ecef GridFrame::ecef(GridPosition place, EllipsoidalHeight h) const {
    const LatLon at = lat_lon(place);
    return to_ecef({at.lat, at.lon, h});
}

GridFrame::Spacing GridFrame::spacing(double row) const {
    const double lat = lat_lon({0, row}).lat.radians();
    const double w2 = 1 - wgs84::kEccentricity2 * std::sin(lat) * std::sin(lat);
    const double across = wgs84::kSemiMajor / std::sqrt(w2);  // radius of curvature in the prime vertical
    const double along = across * (1 - wgs84::kEccentricity2) / w2;  // in the meridian
    return {std::max(0.0, across * std::cos(lat)) * Degrees{step_x}.radians(),
            along * Degrees{step_y}.radians()};
}

int GridFrame::levels() const {
    const int side = std::max(columns, rows);
    int n = 1;
    while ((1 << n) + 1 < side) ++n;
    assert(n < 31);
    return n;
}

int GridFrame::padded_side() const {
    return (1 << levels()) + 1;
}

}  // namespace relevo::geo
