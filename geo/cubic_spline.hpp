#pragma once

#include <array>
#include <span>
#include <vector>

namespace relevo::geo {

// Interpolating cubic B-splines on equal steps (C2; Unser 1999, "Splines: a perfect fit for signal and image
// processing"): the spline at t in [0, 1) past sample k is the sum of spline_weights(t) times the
// coefficients k-1 ... k+2.

/// Turns samples of a periodic function into the coefficients of its spline, in place. \pre not empty
void to_periodic_spline_coefficients(std::span<double> samples);

/// The coefficients of the spline through samples of a line that ends: two more than samples, the first
/// belongs to a place one step before the first sample. At both ends the outer two pieces are one cubic ("not
/// a knot"), so that a cubic polynomial comes back exactly. \pre at least 4 samples
std::vector<double> line_spline_coefficients(std::span<const double> samples);

/// Weights of the four coefficients around a place, t in [0, 1] past the second of them.
std::array<double, 4> spline_weights(double t);

}  // namespace relevo::geo
