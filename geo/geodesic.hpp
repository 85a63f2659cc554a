#pragma once

#include <memory>
#include <span>

#include "geo/position.hpp"

namespace relevo::geo {

/// The shortest line on the WGS 84 ellipsoid between two places (Karney 2013, by GeographicLib: 15 nm).
struct GeodesicLine {
    double length_m = 0;
    Degrees azimuth1;  ///< at the start, clockwise from north, in [0, 360)
    Degrees azimuth2;  ///< at the end, in the direction of travel
};
GeodesicLine geodesic(LatLon from, LatLon to);

/// The place that a geodesic reaches after length_m metres, lon in [-180, 180].
LatLon geodesic_destination(LatLon from, Degrees azimuth, double length_m);

/// Points along the geodesic between two places; faster than geodesic_destination for many of them. Copies
/// share the same line.
class GeodesicPath {
  public:
    GeodesicPath(LatLon from, LatLon to);

    double length_m() const;

    /// The place after distance_m metres. lon is continuous from the start's: a path across the antimeridian
    /// runs on past 180.
    LatLon at(double distance_m) const;

    /// The direction of travel there, clockwise from north, in [0, 360).
    Degrees azimuth(double distance_m) const;

    /// Both at once, for little more than one.
    struct Point {
        LatLon place;
        Degrees azimuth;
    };
    Point point(double distance_m) const;

  private:
    struct Line;
    std::shared_ptr<const Line> line_;
};

/// Area and perimeter of a polygon whose sides are geodesics. Positive whatever its direction; the smaller of
/// the two parts of the earth.
struct GeodesicArea {
    double area_m2 = 0;
    double perimeter_m = 0;
    bool counter_clockwise = true;  ///< that part is to the left of the sides in their order
};
GeodesicArea geodesic_area(std::span<const LatLon> polygon);

}  // namespace relevo::geo
