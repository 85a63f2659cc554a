#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "geo/angle.hpp"
#include "geo/height.hpp"

namespace relevo::geo {

/// A place on the WGS 84 ellipsoid. lat in [-90, 90]; lon any finite angle (continuous across the
/// antimeridian).
struct LatLon {
    Degrees lat;
    Degrees lon;
};

/// A position as latitude, longitude and height above the WGS 84 ellipsoid.
struct Geodetic {
    Degrees lat;
    Degrees lon;
    EllipsoidalHeight h;
};

/// An earth-centred, earth-fixed position (WGS 84), metres: x to (0, 0), y to (0, 90 E), z to the north pole.
struct Ecef {
    glm::dvec3 m{0};

    friend glm::dvec3 operator-(const Ecef& a, const Ecef& b) { return a.m - b.m; }
    friend Ecef operator+(const Ecef& a, const glm::dvec3& offset) { return {a.m + offset}; }
};

/// A position relative to an EnuFrame's origin, metres: x east, y north, z up along the ellipsoid's normal.
struct Enu {
    glm::dvec3 m{0};
};

/// Geodetic to ECEF. Error under 10 nm from -11 km to 10 000 km of height (measured against long double:
/// 3.8 nm).
Ecef to_ecef(const Geodetic& position);

/// ECEF to geodetic, lon in [-180, 180]. to_ecef of the result gives the position back to 10 nm from -11 km
/// to 10 000 km of height (measured: 5.6 nm).
Geodetic to_geodetic(const Ecef& position);

/// The local east-north-up frame at a position.
class EnuFrame {
  public:
    explicit EnuFrame(const Geodetic& origin);

    Enu from_ecef(const Ecef& position) const;
    Ecef to_ecef(const Enu& position) const;

    const Ecef& origin() const { return origin_; }
    /// Unit vectors of the frame in ECEF.
    glm::dvec3 east() const { return axes_[0]; }
    glm::dvec3 north() const { return axes_[1]; }
    glm::dvec3 up() const { return axes_[2]; }

  private:
    Ecef origin_;
    glm::dmat3 axes_;  // columns: east, north, up
};

}  // namespace relevo::geo
