#pragma once

#include <optional>

#include "geo/geodesic.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// A geodesic line and what it does over the ground. Ground figures are absent where the line leaves the data
/// or crosses a void.
struct LineMeasurement {
    geo::GeodesicLine geodesic;
    /// Length of the bilinear surface along the line in space, at its height above the ellipsoid: each metre
    /// of the geodesic is 1 + h/R long (R: the ellipsoid's radius in the line's direction), and rises by dh.
    /// Relative error of the integration under 1e-6.
    std::optional<double> surface_m;
    std::optional<double> climb_m;    ///< sum of all rises of H
    std::optional<double> descent_m;  ///< sum of all falls, positive
};
Result<LineMeasurement> measure_line(HeightSampler& sampler, geo::LatLon from, geo::LatLon to);

}  // namespace relevo::lod
