#pragma once

#include <cmath>

#include "geo/geodesic.hpp"

namespace relevo::lod {

/// How a straight look from one place to another runs over the curved earth, with atmospheric refraction.
///
/// Light in air of the refraction coefficient k is bent downwards with k times the earth's curvature; over an
/// earth of the effective radius R / (1 - k) it is straight (Torge and Mueller, Geodesy, 4th edition, 2012,
/// section 5.1; the 4/3 earth of radio is k = 0.25). k is 0.13 by day over land (Gauss), 0.07 to 0.2 mostly,
/// and anything near the ground over water or hot plains: no k is right to better than a few percent of the
/// curvature. R is the ellipsoid's radius of curvature in the line's direction, the mean of its curvature at
/// a third and at two thirds of the line: the straight line (k = 0) is within 2 cm over 100 km of the chord
/// in space (measured).
class SightLine {
  public:
    /// \param length_m    of the geodesic between the two places, < 5000 km
    /// \param curvature_per_m  of the ellipsoid along it, see mean_curvature()
    /// \param eye_h_m, target_h_m  above the ellipsoid
    /// \pre refraction < 1
    SightLine(double length_m, double curvature_per_m, double refraction, double eye_h_m, double target_h_m)
        : curvature_(curvature_per_m * (1 - refraction)),
          length_(length_m),
          eye_(eye_h_m),
          target_(target_h_m) {}

    /// Height above the ellipsoid after a distance along the geodesic; from 0 to the length.
    double height(double distance_m) const {
        if (length_ == 0) return eye_;
        if (curvature_ == 0) return eye_ + (target_ - eye_) * distance_m / length_;
        // A straight line in polar coordinates, r over the angle p: sin P / r = sin(P - p) / r0 + sin p / r1.
        // With r = R + h and e = h / (R + h) this is R + what stands here: no digits are lost to R.
        const double whole = length_ * curvature_;
        const double here = distance_m * curvature_;
        const double sin_to = std::sin(whole - here);
        const double sin_from = std::sin(here);
        const double e0 = eye_ * curvature_ / (1 + eye_ * curvature_);
        const double e1 = target_ * curvature_ / (1 + target_ * curvature_);
        // sin P - sin(P - p) - sin p = -4 sin(P/2) sin(p/2) sin((P - p)/2)
        const double bulge =
            -4 * std::sin(0.5 * whole) * std::sin(0.5 * here) * std::sin(0.5 * (whole - here));
        return (bulge + sin_to * e0 + sin_from * e1) / (sin_to * (1 - e0) + sin_from * (1 - e1)) / curvature_;
    }

    double length_m() const { return length_; }
    /// Of the earth as the straight line sees it.
    double effective_curvature() const { return curvature_; }

  private:
    double curvature_;
    double length_;
    double eye_;
    double target_;
};

/// Curvature of the WGS 84 ellipsoid at a latitude in the direction of an azimuth, 1/m (Euler's formula).
double ellipsoid_curvature(geo::Degrees lat, geo::Degrees azimuth);

/// Its mean at a third and two thirds of a geodesic.
double mean_curvature(const geo::GeodesicPath& path);

}  // namespace relevo::lod
