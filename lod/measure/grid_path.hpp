#pragma once

#include <vector>

#include "geo/frame.hpp"
#include "geo/geodesic.hpp"

namespace relevo::lod {

/// A geodesic as it runs through a grid. It is not straight there, so its crossings of rows and columns are
/// found on the line itself.
///
/// Two facts make that certain: along a geodesic the longitude is monotone, and on either side of the one
/// point nearest to a pole (a shortest line has at most one) the latitude is too. So every crossing is the
/// only root of a monotone function. In the plane of a polar grid a geodesic turns one way all along, as the
/// scale grows with the distance from the pole alone, which stays on one side: between the places where it
/// goes along a row or a column, both coordinates are monotone.
class GridPath {
  public:
    GridPath(const geo::GridFrame& frame, geo::LatLon from, geo::LatLon to);

    double length_m() const { return path_.length_m(); }

    /// Where the line is after a distance, and where it goes.
    struct Point {
        geo::LatLon place;
        geo::GridPosition grid;
        double columns_per_m = 0;  ///< without bound towards a pole
        double rows_per_m = 0;
        double curvature_per_m = 0;  ///< of the ellipsoid in the line's direction
    };

    /// \param turn  whole turns to be added to the line's longitude (GridPath::Stretch::turn)
    Point at(double distance_m, int turn) const;

    /// A part of the line inside the data.
    struct Stretch {
        int turn = 0;
        /// Distances of its begin, of every crossing of a row or a column of posts, and of its end, rising.
        /// Crossings are right to 2e-8 m; of several within 1e-6 of a post spacing one is kept.
        std::vector<double> cuts;
    };

    /// All parts inside the data, in order; what is between them is outside. A line of length 0 inside the
    /// data is one stretch of one cut.
    std::vector<Stretch> stretches() const;

    /// Distances closer than this are the same place to the grid.
    double same_place_m() const { return same_place_m_; }

  private:
    struct Interval;
    std::vector<Interval> monotone_pieces() const;
    std::vector<Interval> polar_pieces() const;
    std::vector<Interval> intervals_inside() const;
    void add_crossings(const Interval& inside, bool of_columns, std::vector<double>& cuts) const;

    geo::GridFrame frame_;
    geo::GeodesicPath path_;
    double same_place_m_ = 0;
    /// Of data all round the earth: how far a line may go beyond its first and last column, which are the
    /// same place to half a step; negative where they overlap.
    double seam_columns_ = 0;
};

}  // namespace relevo::lod
