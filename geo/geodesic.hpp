#pragma once

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

/// The place that a geodesic reaches after length_m metres.
LatLon geodesic_destination(LatLon from, Degrees azimuth, double length_m);

/// Points along one geodesic; faster than geodesic_destination for many of them.
class GeodesicPath {
  public:
    GeodesicPath(LatLon from, LatLon to);
    double length_m() const { return length_m_; }
    LatLon at(double distance_m) const;

  private:
    LatLon from_;
    Degrees azimuth_;
    double length_m_;
};

/// Area and perimeter of a polygon whose sides are geodesics. Positive whatever its direction; the smaller of the two
/// parts of the earth.
struct GeodesicArea {
    double area_m2 = 0;
    double perimeter_m = 0;
};
GeodesicArea geodesic_area(std::span<const LatLon> polygon);

}  // namespace relevo::geo
