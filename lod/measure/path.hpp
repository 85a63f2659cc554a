#pragma once

#include <span>
#include <vector>

#include "lod/measure/line.hpp"

namespace relevo::lod {

/// A path of geodesics over two or more vertices.
struct PathMeasurement {
    std::vector<LineMeasurement> legs;  ///< one between each two vertices
    /// At each inner vertex: from the direction of arrival to that of leaving, to the right positive, in
    /// [-180, 180) degrees. A leg of no length has no direction of its own: GeographicLib's, the end's.
    std::vector<geo::Degrees> turns;

    // Sums over the legs. Ground figures are absent where one leaves the data or crosses a void.
    double length_m = 0;
    std::optional<double> surface_m;
    std::optional<double> climb_m;
    std::optional<double> descent_m;
};

/// \pre at least two places
Result<PathMeasurement> measure_path(HeightSampler& sampler, std::span<const geo::LatLon> path);

}  // namespace relevo::lod
