#pragma once

#include "geo/position.hpp"

namespace relevo::geo {

/// What the columns and rows of a grid run along.
enum class FrameKind {
    geographic,  ///< columns along longitude, rows along latitude; steps in degrees
};

/// A place in a grid: column to the east, row to the south, in posts; (0, 0) is the north-west post.
/// Fractions lie between posts, values outside [0, columns - 1] x [0, rows - 1] outside the data.
struct GridPosition {
    double column = 0;
    double row = 0;
};

/// Where the posts of a scene's grid lie on the earth. Posts are points: there is no half pixel anywhere.
struct GridFrame {
    FrameKind kind = FrameKind::geographic;
    double west = 0;    ///< longitude of column 0, degrees, in [-180, 180)
    double north = 0;   ///< latitude of row 0, degrees
    double step_x = 0;  ///< between columns, degrees, > 0; longitude runs on past 180 without a jump
    double step_y = 0;  ///< between rows, degrees, > 0; rows run south
    int columns = 0;    ///< posts with data, west to east
    int rows = 0;       ///< posts with data, north to south

    /// Latitude and longitude of a place in the grid (also outside the data). lon is continuous: not wrapped.
    /// Beyond a pole lat stays at the pole.
    LatLon lat_lon(GridPosition place) const;

    /// The inverse of lat_lon, whichever turn lon is given in: the column is the one nearest to the middle of
    /// the data, so that a scene across the antimeridian is found from both sides. Round trip: 1e-9 posts for
    /// steps of 1" and more.
    GridPosition grid_position(LatLon place) const;

    /// ECEF position of a place in the grid at height h, by GeographicLib: the exact path. The fast one is
    /// PostPositions (post_positions.hpp), which agrees to 4 nm.
    Ecef ecef(GridPosition place, EllipsoidalHeight h) const;

    /// Distance in metres between neighbouring columns and between neighbouring rows at a row of the grid.
    struct Spacing {
        double east_m = 0;
        double north_m = 0;
    };
    Spacing spacing(double row) const;

    /// Smallest n with 2^n + 1 >= max(columns, rows), at least 1: the side of the padded grid of the meshes.
    int levels() const;
    /// 2^levels() + 1.
    int padded_side() const;
};

}  // namespace relevo::geo
