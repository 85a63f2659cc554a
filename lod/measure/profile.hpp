#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// A place on a profile.
struct ProfileSample {
    double distance_m = 0;  ///< along the geodesics
    geo::LatLon place;
    std::optional<double> H_m;  ///< nothing for a void or outside
    std::optional<double> h_m;  ///< above the ellipsoid; nothing too where the datum's geoid is unknown
};

/// A part of a profile without heights.
struct ProfileGap {
    double from_m = 0;
    double to_m = 0;
    bool outside = false;  ///< of the data; else a void in it
};

/// Heights along a path, and what follows from them.
struct Profile {
    /// At the path's vertices, at every crossing of a row or a column of posts, and at the extremum inside a
    /// cell where there is one. Between neighbouring samples with a height the bilinear surface has no peak
    /// or dip. A gap has a sample without height at either end, at the distances of the samples with heights
    /// that it lies between.
    std::vector<ProfileSample> samples;
    std::vector<double> vertices_m;  ///< distances of the path's vertices: the first 0, the last its length
    std::vector<ProfileGap> gaps;
    double measured_m = 0;  ///< length with heights, which the figures below are of

    struct Extreme {
        double value = 0;
        double distance_m = 0;
        geo::LatLon place;
    };
    // All absent where nothing has a height; means and slopes too where that has no length.
    std::optional<Extreme> lowest;   ///< H, metres: the first of equals
    std::optional<Extreme> highest;  ///< H, metres
    /// The integral of H of the bilinear surface along the geodesics over its length, and not a mean of
    /// samples, which crowd where cells are small: Gauss-Legendre of three points in each cell, exact for the
    /// quadratic that the surface is along a straight line; error under 1e-9 of the relief.
    std::optional<double> mean_H_m;
    /// Slopes are rises of H for a metre on the ellipsoid, in the direction of travel: 1 is 45 degrees.
    std::optional<Extreme> steepest_up;    ///< the largest slope; absent where it nowhere rises
    std::optional<Extreme> steepest_down;  ///< the least, negative; absent where it nowhere falls
    std::optional<double> mean_slope;      ///< of absolute values: (climb + descent) / length
};

/// The profile along the geodesics between consecutive places. \pre at least two places
Result<Profile> measure_profile(HeightSampler& sampler, std::span<const geo::LatLon> path);

/// The samples alone, of one line.
Result<std::vector<ProfileSample>> profile(HeightSampler& sampler, geo::LatLon from, geo::LatLon to);

}  // namespace relevo::lod
