#pragma once

#include "geo/position.hpp"

namespace relevo::geo {

/// What the columns and rows of a grid run along.
enum class FrameKind {
    geographic,  ///< columns along longitude, rows along latitude; steps in degrees
    ups_north,  ///< columns and rows along easting and northing of UPS around the north pole; steps in metres
    ups_south,  ///< the same around the south pole
};

/// False easting and northing of UPS: its coordinates at the pole, metres.
inline constexpr double kUpsFalseOrigin = 2e6;

/// A place in a grid: column and row in posts; (0, 0) is the first post. In a geographic grid columns run
/// east and rows south; in a polar one columns run with growing easting and rows with falling northing.
/// Fractions lie between posts, values outside [0, columns - 1] x [0, rows - 1] outside the data.
struct GridPosition {
    double column = 0;
    double row = 0;
};

/// Where the posts of a scene's grid lie on the earth. Posts are points: there is no half pixel anywhere.
///
/// Polar grids are UPS, the polar stereographic projection of WGS 84 with scale 0.994 at the pole and 2000 km
/// of false easting and northing (EPSG:5041 and EPSG:5042). The other pole is infinitely far in them; a place
/// beyond the equator is allowed, and stretched.
struct GridFrame {
    FrameKind kind = FrameKind::geographic;
    double west = 0;   ///< longitude of column 0, degrees, in [-180, 180); polar: its easting, metres
    double north = 0;  ///< latitude of row 0, degrees; polar: its northing, metres
    double step_x =
        0;  ///< between columns, degrees or metres, > 0; longitude runs on past 180 without a jump
    double step_y = 0;  ///< between rows, degrees or metres, > 0; latitude or northing falls
    int columns = 0;    ///< posts with data, along a row
    int rows = 0;       ///< posts with data, along a column

    bool is_polar() const { return kind != FrameKind::geographic; }

    /// Latitude and longitude of a place in the grid (also outside the data). Geographic: lon is continuous,
    /// not wrapped; beyond a pole lat stays at the pole. Polar: lon in [-180, 180], 0 at the pole itself.
    LatLon lat_lon(GridPosition place) const;

    /// The inverse of lat_lon, whichever turn lon is given in. In a geographic grid the column is the one
    /// nearest to the middle of the data, so that a scene across the antimeridian is found from both sides.
    /// Round trip: 1e-9 posts for steps of 1", in a polar grid 3e-9 m. The pole that a polar grid is not
    /// around is somewhere very far, but finite. A place between the last column and the first of a grid that
    /// closes is at the nearer of the two: they are the same place, to half a step.
    GridPosition grid_position(LatLon place) const;

    /// Is a place within the outermost posts of the data, or on them? Never of NaN.
    bool contains(GridPosition place) const;

    /// ECEF position of a place in the grid at height h, by GeographicLib: the exact path. The fast one is
    /// PostPositions (post_positions.hpp), which agrees to 4 nm, in polar grids to 8 nm.
    Ecef ecef(GridPosition place, EllipsoidalHeight h) const;

    /// Distance in metres on the ellipsoid between neighbouring columns and between neighbouring rows at a
    /// place.
    struct Spacing {
        double column_m = 0;
        double row_m = 0;
    };
    Spacing spacing(GridPosition place) const;

    /// The azimuth of the grid's upward direction (towards falling rows) at a longitude: 0 in a geographic
    /// grid.
    Degrees up_azimuth(Degrees lon) const;

    /// Does the last column lie on the first one, to half a step: is the grid all round the earth?
    bool closes() const;

    /// The data's bounds, degrees. east is at least west: beyond 180 where the data crosses the antimeridian.
    /// A grid with a pole inside has all longitudes, -180 to 180.
    struct Extent {
        double west = 0;
        double south = 0;
        double east = 0;
        double north = 0;
    };
    Extent extent() const;

    /// Smallest n with 2^n + 1 >= max(columns, rows), at least 1: the side of the padded grid of the meshes.
    int levels() const;
    /// 2^levels() + 1.
    int padded_side() const;
};

}  // namespace relevo::geo
