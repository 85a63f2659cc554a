#include "geo/geodesic.hpp"

#include <algorithm>
#include <cmath>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <GeographicLib/PolygonArea.hpp>

namespace relevo::geo {

using GeographicLib::Geodesic;

GeodesicLine geodesic(LatLon from, LatLon to) {
    double length = 0;
    double azimuth1 = 0;
    double azimuth2 = 0;
    Geodesic::WGS84().Inverse(from.lat.value, from.lon.value, to.lat.value, to.lon.value, length, azimuth1,
                              azimuth2);
    return {length, wrapped_360(Degrees{azimuth1}), wrapped_360(Degrees{azimuth2})};
}

LatLon geodesic_destination(LatLon from, Degrees azimuth, double length_m) {
    double lat = 0;
    double lon = 0;
    Geodesic::WGS84().Direct(from.lat.value, from.lon.value, azimuth.value, length_m, lat, lon);
    return {Degrees{lat}, Degrees{lon}};
}

struct GeodesicPath::Line {
    GeographicLib::GeodesicLine line;
    double length_m;
};

GeodesicPath::GeodesicPath(LatLon from, LatLon to) {
    // The length is geodesic()'s own, to the last bit: the line's would be the same rounded otherwise.
    line_ = std::make_shared<const Line>(
        Line{Geodesic::WGS84().InverseLine(
                 from.lat.value, from.lon.value, to.lat.value, to.lon.value,
                 Geodesic::LATITUDE | Geodesic::LONGITUDE | Geodesic::AZIMUTH | Geodesic::DISTANCE_IN),
             geodesic(from, to).length_m});
}

double GeodesicPath::length_m() const {
    return line_->length_m;
}

GeodesicPath::Point GeodesicPath::point(double distance_m) const {
    double lat = 0;
    double lon = 0;
    double azimuth = 0;
    double unused = 0;
    line_->line.GenPosition(
        false, distance_m,
        Geodesic::LATITUDE | Geodesic::LONGITUDE | Geodesic::LONG_UNROLL | Geodesic::AZIMUTH, lat, lon,
        azimuth, unused, unused, unused, unused, unused);
    return {{Degrees{lat}, Degrees{lon}}, wrapped_360(Degrees{azimuth})};
}

LatLon GeodesicPath::at(double distance_m) const {
    return point(distance_m).place;
}

Degrees GeodesicPath::azimuth(double distance_m) const {
    return point(distance_m).azimuth;
}

GeodesicArea geodesic_area(std::span<const LatLon> polygon) {
    GeographicLib::PolygonArea sides(Geodesic::WGS84());
    for (const LatLon& corner : polygon) sides.AddPoint(corner.lat.value, corner.lon.value);
    GeodesicArea result;
    sides.Compute(false, true, result.perimeter_m,
                  result.area_m2);  // signed: within half of the earth's area
    result.counter_clockwise = result.area_m2 >= 0;
    result.area_m2 = std::abs(result.area_m2);
    return result;
}

}  // namespace relevo::geo
