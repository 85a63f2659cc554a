#pragma once

#include <functional>
#include <optional>
#include <span>

#include "geo/geodesic.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::lod {

struct AreaRequest {
    std::optional<double> plane_H_m;  ///< of the plane that volumes are above and below; none: the lowest H
    std::function<bool(double)> progress;  ///< told the part done, 0 to 1, from any thread; false stops it
};

/// A polygon with geodesic sides, and the ground in it.
struct AreaMeasurement {
    /// On the WGS 84 ellipsoid, of the whole polygon, exact whatever the data (Karney 2013).
    geo::GeodesicArea geodesic;

    // What the polygon's area on the ellipsoid is made of; together geodesic.area_m2.
    double measured_m2 = 0;  ///< with heights: all figures below are of this part
    double void_m2 = 0;      ///< of cells with a void corner
    double outside_m2 = 0;   ///< of the data; less than 1e-6 of the polygon is rounding, and none

    struct Extreme {
        double value = 0;
        geo::LatLon place;
    };
    // All absent where nothing has a height.
    /// Of the bilinear surface, at its height above the ellipsoid.
    std::optional<double> surface_m2;
    std::optional<Extreme> lowest;         ///< H, metres
    std::optional<Extreme> highest;        ///< H, metres
    std::optional<double> mean_H_m;        ///< by area on the ellipsoid
    std::optional<double> mean_slope_deg;  ///< of the angle, by area on the ellipsoid
    std::optional<Extreme> steepest_deg;
    std::optional<double> plane_H_m;        ///< the surface H = plane is as curved as the vertical datum
    std::optional<double> volume_above_m3;  ///< between it and the surface, by area on the ellipsoid
    std::optional<double> volume_below_m3;
};

/// Measures a polygon over the full data, block by block on all cores: about 6 MiB for each core whatever the
/// size of the polygon, and the same bits whatever their number. Sides are followed to 1e-6 posts. Errors of
/// the integrals: cell_sums.hpp. Fails as grid_rings does, with ErrorKind::damaged where a block is, with
/// ErrorKind::internal where `progress` stopped it.
/// \pre at least 3 vertices
Result<AreaMeasurement> measure_area(const Scene& scene, std::span<const geo::LatLon> polygon,
                                     const AreaRequest& request = {});

}  // namespace relevo::lod
