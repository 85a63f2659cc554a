#include "geo/frame.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <GeographicLib/PolarStereographic.hpp>

#include "geo/ellipsoid.hpp"

namespace relevo::geo {
namespace {

/// UPS coordinates of a place of a polar grid, from the pole.
struct FromPole {
    double x;
    double y;
};

FromPole from_pole(const GridFrame& frame, GridPosition place) {
    return {frame.west + place.column * frame.step_x - kUpsFalseOrigin,
            frame.north - place.row * frame.step_y - kUpsFalseOrigin};
}

struct PolarPlace {
    LatLon place;
    double scale;  // metres of the grid for one on the ellipsoid
};

PolarPlace polar_place(FrameKind kind, FromPole at) {
    const bool north = kind == FrameKind::ups_north;
    double lat = 0;
    double lon = 0;
    double convergence = 0;
    double scale = 0;
    GeographicLib::PolarStereographic::UPS().Reverse(north, at.x, at.y, lat, lon, convergence, scale);
    if (at.x == 0 && at.y == 0) lon = 0;  // any would do; the signs of the zeros must not choose
    return {{Degrees{lat}, Degrees{lon}}, scale};
}

}  // namespace

LatLon GridFrame::lat_lon(GridPosition place) const {
    if (is_polar()) return polar_place(kind, from_pole(*this, place)).place;
    // Clamped: rounding at a pole's row, and padding beyond it, must not make a latitude that is none.
    return {Degrees{std::clamp(north - place.row * step_y, -90.0, 90.0)},
            Degrees{west + place.column * step_x}};
}

GridPosition GridFrame::grid_position(LatLon place) const {
    if (is_polar()) {
        double x = 0;
        double y = 0;
        GeographicLib::PolarStereographic::UPS().Forward(kind == FrameKind::ups_north, place.lat.value,
                                                         wrapped_180(place.lon).value, x, y);
        return {(x - (west - kUpsFalseOrigin)) / step_x, ((north - kUpsFalseOrigin) - y) / step_y};
    }
    const double middle = 0.5 * (columns - 1);
    const double from_middle = std::remainder(place.lon.value - (west + middle * step_x), 360.0);
    double column = middle + from_middle / step_x;
    if (closes()) column = std::clamp(column, 0.0, static_cast<double>(columns - 1));
    return {column, (north - place.lat.value) / step_y};
}

Ecef GridFrame::ecef(GridPosition place, EllipsoidalHeight h) const {
    const LatLon at = lat_lon(place);
    return to_ecef({at.lat, at.lon, h});
}

GridFrame::Spacing GridFrame::spacing(GridPosition place) const {
    if (is_polar()) {
        const double scale = polar_place(kind, from_pole(*this, place)).scale;  // in all directions
        return {step_x / scale, step_y / scale};
    }
    const double lat = lat_lon(place).lat.radians();
    const double w2 = 1 - wgs84::kEccentricity2 * std::sin(lat) * std::sin(lat);
    const double across = wgs84::kSemiMajor / std::sqrt(w2);  // radius of curvature in the prime vertical
    const double along = across * (1 - wgs84::kEccentricity2) / w2;  // in the meridian
    return {std::max(0.0, across * std::cos(lat)) * Degrees{step_x}.radians(),
            along * Degrees{step_y}.radians()};
}

Degrees GridFrame::up_azimuth(Degrees lon) const {
    switch (kind) {
        case FrameKind::ups_north:
            return wrapped_360(lon);
        case FrameKind::ups_south:
            return wrapped_360(-lon);
        case FrameKind::geographic:
            break;
    }
    return Degrees{0};
}

bool GridFrame::contains(GridPosition place) const {
    return place.column >= 0 && place.row >= 0 && place.column <= columns - 1 && place.row <= rows - 1;
}

bool GridFrame::closes() const {
    return !is_polar() && columns > 1 && std::abs((columns - 1) * step_x - 360) <= 0.5 * step_x;
}

GridFrame::Extent GridFrame::extent() const {
    const GridPosition last{static_cast<double>(columns - 1), static_cast<double>(rows - 1)};
    if (!is_polar()) {
        const LatLon first_place = lat_lon({0, 0});
        const LatLon last_place = lat_lon(last);
        return {first_place.lon.value, last_place.lat.value, last_place.lon.value, first_place.lat.value};
    }
    // Latitude depends on the distance from the pole alone, which is largest at a corner; and seen from a
    // pole outside, a rectangle's widest angle is between corners too.
    const FromPole low = from_pole(*this, {0, last.row});
    const FromPole high = from_pole(*this, {last.column, 0});
    const FromPole nearest{std::clamp(0.0, low.x, high.x), std::clamp(0.0, low.y, high.y)};
    const FromPole farthest{std::max(-low.x, high.x), std::max(-low.y, high.y)};
    double near_lat = polar_place(kind, nearest).place.lat.value;
    double far_lat = polar_place(kind, farthest).place.lat.value;
    if (kind == FrameKind::ups_north) std::swap(near_lat, far_lat);
    Extent extent{-180, near_lat, 180, far_lat};
    if (nearest.x == 0 && nearest.y == 0) return extent;

    const double middle = polar_place(kind, {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)}).place.lon.value;
    double west_of_middle = 0;
    double east_of_middle = 0;
    for (const FromPole corner : std::array<FromPole, 4>{{low, {low.x, high.y}, {high.x, low.y}, high}}) {
        const double off = std::remainder(polar_place(kind, corner).place.lon.value - middle, 360.0);
        west_of_middle = std::min(west_of_middle, off);
        east_of_middle = std::max(east_of_middle, off);
    }
    extent.west = wrapped_180(Degrees{middle + west_of_middle}).value;
    extent.east = extent.west + (east_of_middle - west_of_middle);
    return extent;
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
