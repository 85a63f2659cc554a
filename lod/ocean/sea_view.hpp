#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lod/ocean/sea_chart.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// The sea below an eye, for the meshes that cover what is seen of it. Near the eye it is a sphere through
/// the eye's nadir at sea level, with the ellipsoid's mean radius there: 0.34 % of the curvature is left out,
/// 3 cm at 10 km. Meshes only choose by it where their vertices go; where these lie in space is exact.
struct SeaView {
    /// \param sea_h_m  of sea level above the ellipsoid at the eye's nadir
    /// \param crest_m  most that waves rise above sea level, and sink below it
    /// \param wave_m   their height at the nadir
    SeaView(const View& view, const SeaChart& chart, double sea_h_m, double crest_m, double wave_m = 0);

    const View& view;
    const SeaChart& chart;
    glm::dvec2 nadir;            ///< in the chart
    glm::dvec3 east, north, up;  ///< at the nadir, in ECEF axes; east and north along the chart's axes
    double radius_m;             ///< of the sphere, sea level
    double eye_m;                ///< height of the eye above sea level
    double clear_m;              ///< the same above the waves or below them, at least kLeastClear
    static constexpr double kLeastClear = 0.3;
    double crest_m;
    /// Along the sea from the nadir to the farthest place at which a crest can be seen.
    double reach_m;

    /// The distance at which an error of the waves' height, seen from the side, is as many pixels as it is at
    /// most for the sea from `along_m` beyond the nadir on: nearer to the nadir one looks down on it, along
    /// the error.
    double error_distance_m(double along_m) const;

    /// Offset from the eye, ECEF axes, of a place on the sphere, `at` metres from the nadir along the chart's
    /// axes, `height_m` above sea level.
    glm::dvec3 offset(const glm::dvec2& at, double height_m) const;
};

/// Along a sphere's surface from the foot of a point to the farthest point that it sees of what rises by
/// `crest_m` above the surface: R (acos(R / (R + h)) + acos(R / (R + crest))). Below the surface, and where
/// waves may hide nothing, half the sphere at most.
double horizon_m(double radius_m, double height_m, double crest_m);

/// Pixels that a length of one metre across the line of sight is at most, a metre away, in any direction of
/// the picture that may have sea, if the length lies as heights do: what turns errors of the waves into
/// pixels.
double height_px(const View& view);

}  // namespace relevo::lod
