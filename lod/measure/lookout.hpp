#pragma once

#include <utility>

#include "geo/geodesic.hpp"
#include "lod/measure/high_ground.hpp"
#include "lod/measure/line_over_ground.hpp"
#include "lod/measure/viewshed.hpp"

namespace relevo::lod {

/// Lines of sight from one eye. Keeps references to the frame, the ground and how one looks.
class Lookout {
  public:
    /// \param ground  of the box
    /// \param eye_h   above the ellipsoid
    Lookout(const geo::GridFrame& frame, const BlockGrid::Box& box, const HighGround& ground, geo::LatLon eye,
            double eye_h, const Looking& looking);

    /// What is seen of a target over a post of the box.
    /// \param hint  where the last line was blocked, and then this
    Viewshed::Seen look(int column, int row, double radius, double& hint) const;

    /// How far, in posts, the cubic to a post is from the geodesic.
    double bend_error(int column, int row) const;

  private:
    geo::LatLon place(int column, int row) const;
    /// In the box.
    geo::GridPosition position(const geo::GeodesicPath& path, double part) const;
    std::pair<Cubic, Cubic> cubics(const geo::GeodesicPath& path, int column, int row) const;

    const geo::GridFrame& frame_;
    BlockGrid::Box box_;
    const HighGround& ground_;
    const Looking& looking_;
    geo::GridPosition eye_;
    double eye_h_;
    geo::LatLon eye_place_;
};

}  // namespace relevo::lod
