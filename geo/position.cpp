#include "geo/position.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>

namespace relevo::geo {

Ecef to_ecef(const Geodetic& position) {
    glm::dvec3 m;
    GeographicLib::Geocentric::WGS84().Forward(position.lat.value, position.lon.value, position.h.m, m.x, m.y,
                                               m.z);
    return {m};
}

Geodetic to_geodetic(const Ecef& position) {
    double lat = 0;
    double lon = 0;
    double h = 0;
    GeographicLib::Geocentric::WGS84().Reverse(position.m.x, position.m.y, position.m.z, lat, lon, h);
    return {Degrees{lat}, Degrees{lon}, EllipsoidalHeight{h}};
}

EnuFrame::EnuFrame(const Geodetic& origin) : origin_(geo::to_ecef(origin)) {
    // Exact at multiples of 90 degrees, unlike sine and cosine of radians.
    double sin_lat = 0;
    double cos_lat = 0;
    double sin_lon = 0;
    double cos_lon = 0;
    GeographicLib::Math::sincosd(origin.lat.value, sin_lat, cos_lat);
    GeographicLib::Math::sincosd(origin.lon.value, sin_lon, cos_lon);
    axes_ = {glm::dvec3{-sin_lon, cos_lon, 0}, glm::dvec3{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat},
             glm::dvec3{cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}};
}

// The difference is taken first: near the origin it is exact, and nothing of the earth's radius is left to
// round.
Enu EnuFrame::from_ecef(const Ecef& position) const {
    return {(position - origin_) * axes_};
}

Ecef EnuFrame::to_ecef(const Enu& position) const {
    return origin_ + axes_ * position.m;
}

}  // namespace relevo::geo
