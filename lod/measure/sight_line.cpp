#include "lod/measure/sight_line.hpp"

#include "geo/ellipsoid.hpp"

namespace relevo::lod {

double ellipsoid_curvature(geo::Degrees lat, geo::Degrees azimuth) {
    const double sin_lat = std::sin(lat.radians());
    const double w2 = 1 - geo::wgs84::kEccentricity2 * sin_lat * sin_lat;
    const double across = geo::wgs84::kSemiMajor / std::sqrt(w2);
    const double along = across * (1 - geo::wgs84::kEccentricity2) / w2;
    const double north = std::cos(azimuth.radians());
    const double east = std::sin(azimuth.radians());
    return north * north / along + east * east / across;
}

double mean_curvature(const geo::GeodesicPath& path) {
    const auto at = [&](double part) {
        const auto point = path.point(part * path.length_m());
        return ellipsoid_curvature(point.place.lat, point.azimuth);
    };
    return 0.5 * (at(1.0 / 3) + at(2.0 / 3));
}

}  // namespace relevo::lod
