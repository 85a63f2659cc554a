#pragma once

#include <filesystem>
#include <vector>

#include "geo/height.hpp"
#include "geo/position.hpp"
#include "geo/result.hpp"

namespace relevo::geo {

/// A geoid model: the height N of mean sea level above the ellipsoid, everywhere on earth.
///
/// The model's nodes are joined by an interpolating bicubic spline (C2; Unser 1999, "Splines: a perfect fit
/// for signal and image processing"): periodic in longitude, and continued across a pole along the opposite
/// meridian, so that no place on earth is special. At a node it is the node to 1e-12 m. Between the nodes of
/// EGM96 15' it is within 0.03 m of the model (measured against the trigonometric polynomial through the
/// nodes, which the model is: 0.0265 m at most and 1.6 mm RMS in the middle of all cells, where linear
/// interpolation is wrong by up to 1.152 m, 56 mm RMS).
class Geoid {
  public:
    /// EGM96 on its 15' grid, from PROJ's data (egm96_15.gtx, Debian package proj-data).
    /// Fails with a message that names the file where PROJ does not find it.
    static Result<Geoid> egm96();

    /// A grid in the .gtx format (big-endian; whole earth, with or without the closing column).
    static Result<Geoid> from_gtx(const std::filesystem::path& file);

    /// \pre lat in [-90, 90], lon finite
    Undulation undulation(LatLon place) const;

  private:
    Geoid() = default;

    int columns_ = 0;                   // of the periodic grid: 360 / step
    int rows_ = 0;                      // 180 / step + 1, south to north
    double west_ = 0;                   // longitude of column 0, degrees
    std::vector<double> coefficients_;  // of the spline, row by row from the south pole
};

}  // namespace relevo::geo
