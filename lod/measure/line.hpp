#pragma once

#include <optional>
#include <vector>

#include "geo/geodesic.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// A place on a profile.
struct ProfileSample {
    double distance_m = 0;  ///< along the geodesic
    geo::LatLon place;
    std::optional<double> H_m;  ///< nothing for a void or outside
};

/// Heights along the geodesic between two places: at both ends, at every crossing of a row, a column of posts, and at
/// the extremum inside a cell where there is one. Between neighbouring samples the bilinear surface has no peak or dip.
Result<std::vector<ProfileSample>> profile(HeightSampler& sampler, geo::LatLon from, geo::LatLon to);

/// A geodesic line and what it does over the ground. Ground figures are absent where the line leaves the data.
struct LineMeasurement {
    geo::GeodesicLine geodesic;
    std::optional<double> surface_m;  ///< length over the ground, at its height
    std::optional<double> climb_m;    ///< sum of all rises
    std::optional<double> descent_m;  ///< sum of all falls, positive
};
Result<LineMeasurement> measure_line(HeightSampler& sampler, geo::LatLon from, geo::LatLon to);

}  // namespace relevo::lod
