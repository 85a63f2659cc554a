#pragma once

#include <optional>
#include <vector>

#include "geo/geodesic.hpp"
#include "lod/measure/point.hpp"
#include "lod/terrain.hpp"

namespace relevo::viewer {

/// The distance tool: two places of the full data and the geodesic between them. What is drawn does not
/// enter.
class Ruler {
  public:
    /// Sets the first point, then the second; a third begins anew.
    void add(const lod::PointMeasurement& point);
    void clear() { points_.clear(); }

    const std::vector<lod::PointMeasurement>& points() const { return points_; }
    /// With two points.
    std::optional<geo::GeodesicLine> line() const;

    /// Positions along the geodesic on the ground as it is drawn, from one end to the other, for showing it.
    /// A void takes the height before it.
    std::vector<geo::Ecef> on_ground(const lod::Terrain& terrain, double exaggeration) const;

  private:
    std::vector<lod::PointMeasurement> points_;
};

}  // namespace relevo::viewer
