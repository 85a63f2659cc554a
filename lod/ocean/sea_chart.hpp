#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "geo/position.hpp"

namespace relevo::lod {

/// A flat map of the sea: metres east and north of an anchor. Waves and the lattices of meshes are fixed in
/// it, so that neither moves with the eye.
///
/// It is the azimuthal equidistant map of the sphere of the ellipsoid's normals, times the mean radius of
/// curvature at the anchor. Lengths away from the anchor are right to 0.4 % (the ellipsoid's shape), across
/// that to the same and (d / 9 000 km)^2 at a distance d.
class SeaChart {
  public:
    explicit SeaChart(geo::LatLon anchor);

    /// \pre not the anchor's antipode
    glm::dvec2 at(geo::LatLon place) const;
    /// The ellipsoid's outward unit normal.
    glm::dvec3 normal(const glm::dvec2& at) const;
    geo::LatLon place(const glm::dvec2& at) const;

    geo::LatLon anchor() const { return anchor_; }
    double radius_m() const { return radius_m_; }
    /// Unit vectors in ECEF at the anchor.
    const glm::dvec3& east() const { return east_; }
    const glm::dvec3& north() const { return north_; }
    const glm::dvec3& up() const { return up_; }

  private:
    geo::LatLon anchor_;
    glm::dvec3 east_, north_, up_;
    double radius_m_;
};

/// The anchor for an eye: the nearest of a lattice of places some 1000 km apart, of which `middle` is one. It
/// stays the same over a scene of common size, wherever that lies.
geo::LatLon sea_chart_anchor(geo::LatLon middle, geo::LatLon eye);

}  // namespace relevo::lod
