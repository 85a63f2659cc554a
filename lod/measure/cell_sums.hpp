#pragma once

#include <array>
#include <optional>

#include "lod/measure/grid_polygon.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// Sums over the ground of a polygon, or of a part of it.
struct CellSums {
    double void_m2 = 0;           ///< of cells with a void corner; all the rest is of cells without
    double area_m2 = 0;           ///< on the ellipsoid
    double surface_m2 = 0;        ///< of the bilinear surface at its height
    double H_m3 = 0;              ///< integral of H
    double slope_degrees_m2 = 0;  ///< integral of the slope's angle
    double above_m3 = 0;          ///< integral of H - plane where that is positive

    struct Extreme {
        double value = 0;
        geo::GridPosition place;
    };
    std::optional<Extreme> lowest;    ///< H
    std::optional<Extreme> highest;   ///< H
    std::optional<Extreme> steepest;  ///< rise for a metre on the ellipsoid

    /// The sums of both; of equal extremes this one's stay.
    void add(const CellSums& other);
};

/// Four neighbouring posts as the ground between them.
struct GroundCell {
    BilinearCell H;  ///< above the vertical datum
    BilinearCell h;  ///< above the ellipsoid
    /// Metres a column and a row at v = 0, 1/2 and 1 in the cell.
    std::array<double, 3> column_m{};
    std::array<double, 3> row_m{};
    double curvature = 0;  ///< of the ellipsoid, geometric mean, 1/m
};

/// Adds the part of a cell inside a ring, which is in the cell's unit square: u = column, v = row from its
/// north-west post, signed_area positive.
///
/// Each integral over the ring is one along its sides (Green): of F dv with dF/du the integrand. Area and
/// height are exact but for the ellipsoid's metric, a parabola of v. Volumes above the plane are split where
/// the surface crosses it along the ring. Surface and slope are Gauss-Legendre, in steps so short that slopes
/// change by less than 0.5 within one, relative error under 1e-6; but in at most 16 x 16 steps, so that noise
/// of slopes beyond 8 from post to post has an error up to 1e-4. The surface's element is that of the
/// ellipsoid, (1 + h/R)^2 as large, over cos of the slope.
/// \param plane_m  H of the plane that volumes are above
void add_cell(const GroundCell& cell, const GridRing& ring, std::optional<double> plane_m, CellSums& sums);

/// The same for the whole cell.
void add_whole_cell(const GroundCell& cell, std::optional<double> plane_m, CellSums& sums);

/// The area of the ring's part of a cell on the ellipsoid, m2.
double cell_area(const GroundCell& cell, const GridRing& ring);

}  // namespace relevo::lod
