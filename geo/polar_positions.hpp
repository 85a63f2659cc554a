#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/vec3.hpp>

#include "geo/ellipsoid.hpp"
#include "geo/frame.hpp"

namespace relevo::geo {

/// ECEF positions from UPS coordinates without trigonometry: one division and three short polynomials.
///
/// With t the distance from the pole over 2 a k0 / c (Snyder 1987, "Map projections", 21-33), t is the
/// tangent of half the angle chi' between the pole and the *conformal* latitude chi, so that sin chi = (1 -
/// t^2) / (1 + t^2) and cos chi = 2 t / (1 + t^2). The geodetic latitude phi differs from chi by the
/// eccentricity alone: cos phi / cos chi, sin phi / sin chi and the radius of curvature are polynomials in
/// sin^2 chi whose terms fall by e^2 each. Degree 7 leaves less than a double's rounding at every latitude,
/// so that padding is covered too.
class PolarPositions {
  public:
    /// \pre frame.is_polar()
    explicit PolarPositions(const GridFrame& frame);

    /// ECEF of a place in the grid, metres. Agrees with GridFrame::ecef to 8 nm for heights from -11 to 9 km
    /// everywhere in a padded grid (measured: 5.7 nm, most of it the rounding of both).
    glm::dvec3 at(double column, double row, double h_m) const {
        const Place p = place(column, row);
        const double across = radius_(p.v);
        const double equatorial = (across + h_m) * p.cos_lat_by_t;
        return {equatorial * p.x, equatorial * p.y, (kPolarCut * across + h_m) * p.sin_lat};
    }

    /// The ellipsoid's normal at a place.
    glm::dvec3 normal(double column, double row) const {
        const Place p = place(column, row);
        return {p.cos_lat_by_t * p.x, p.cos_lat_by_t * p.y, p.sin_lat};
    }

    /// As GridFrame::spacing, to 1e-13 of it.
    GridFrame::Spacing spacing(double column, double row) const {
        const Place p = place(column, row);
        const double per_unit = radius_(p.v) * p.cos_lat_by_t;
        return {y_column_ * per_unit, std::abs(x_row_) * per_unit};
    }

    /// The grid in a plane on which the conformal sphere is projected from the other pole, its equator being
    /// the unit circle: x towards longitude 0, y towards longitude 90.
    struct Plane {
        double x;  // of the post (0, 0)
        double y;
        double x_row;  // growth of x with a row
        double y_column;
        double pole;  // 1 in the north, -1 in the south
    };
    Plane plane() const { return {x_, y_, x_row_, y_column_, pole_}; }

  private:
    static constexpr double kPolarCut = 1 - wgs84::kEccentricity2;  // z = (1 - e^2) across sin(lat)
    static constexpr std::size_t kTerms = 8;
    /// A polynomial in v = 2 sin^2 chi - 1.
    struct Series {
        std::array<double, kTerms> c{};

        double operator()(double v) const {  // Estrin's scheme: three products deep instead of seven
            const double v2 = v * v;
            const double low = (c[0] + c[1] * v) + (c[2] + c[3] * v) * v2;
            const double high = (c[4] + c[5] * v) + (c[6] + c[7] * v) * v2;
            return low + high * (v2 * v2);
        }
    };
    struct Place {
        double x, y;  // t, towards longitudes 0 and 90
        double v;
        double cos_lat_by_t;  // cos(lat) / t
        double sin_lat;
    };

    Place place(double column, double row) const {
        Place p{};
        p.x = x_ + row * x_row_;
        p.y = y_ + column * y_column_;
        const double t2 = p.x * p.x + p.y * p.y;
        const double q = 1 / (1 + t2);
        const double sin_chi = (1 - t2) * q;
        p.v = 2 * sin_chi * sin_chi - 1;
        p.cos_lat_by_t = 2 * q * cosine_(p.v);
        p.sin_lat = pole_ * sin_chi * sine_(p.v);
        return p;
    }

    Series cosine_;  // cos(lat) / cos chi
    Series sine_;    // sin(lat) / sin chi
    Series radius_;  // of curvature in the prime vertical, m
    double y_;       // of column 0
    double x_;       // of row 0
    double y_column_;
    double x_row_;
    double pole_;  // 1 or -1
};

}  // namespace relevo::geo
