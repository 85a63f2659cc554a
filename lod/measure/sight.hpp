#pragma once

#include <optional>

#include "geo/geodesic.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// How one looks: heights above the ground, and the air's refraction (SightLine).
struct Looking {
    double eye_height_m = 1.7;
    double target_height_m = 0;
    double refraction = 0.13;  ///< k; 0: no air
    friend bool operator==(const Looking&, const Looking&) = default;
};

/// Is a target seen from an eye over the bilinear surface of the full data?
struct SightMeasurement {
    geo::GeodesicLine geodesic;
    std::optional<double> eye_H_m;     ///< ground and eye height; nothing where the ground is not known
    std::optional<double> target_H_m;  ///< likewise

    /// Nothing where that is unknown: an end has no ground, or no known ground is in the way but some of the
    /// line is over voids or outside.
    std::optional<bool> visible;
    double unknown_m = 0;  ///< of the line over voids or outside

    struct Place {
        double distance_m = 0;
        geo::LatLon place;
        double H_m = 0;          ///< of the ground
        double clearance_m = 0;  ///< of the line of sight above it, vertically; negative in the ground
    };
    std::optional<Place> first_blocked;  ///< where the line first goes into the ground: clearance 0
    std::optional<Place> worst;          ///< where it is deepest in the ground; with first_blocked
    /// Where the line comes nearest to the ground between its ends, if it is visible; nothing where the
    /// clearance only grows from the eye and falls to the target.
    std::optional<Place> least_clearance;
};

/// Ground within this of the line of sight only touches it.
inline constexpr double kSightTolerance = 1e-6;

/// Follows the geodesic from cell to cell, to each place where the line of sight may come nearest to the
/// surface within it, so that no ridge between posts is missed. In heights above the ellipsoid: h = H + N
/// (with the scene's geoid; N even within a cell).
/// Fails with ErrorKind::usage for heights or a refraction that make no sense.
Result<SightMeasurement> measure_sight(HeightSampler& sampler, geo::LatLon eye, geo::LatLon target,
                                       const Looking& looking);

/// Do heights and refraction make sense (finite, at least 0; -1 <= k < 1)?
Result<void> check(const Looking& looking);

}  // namespace relevo::lod
