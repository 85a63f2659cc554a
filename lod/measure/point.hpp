#pragma once

#include <optional>
#include <string>

#include "geo/position.hpp"
#include "lod/measure/height_sampler.hpp"
#include "lod/measure/slope.hpp"

namespace relevo::lod {

enum class PointClass { land, sea, none, outside };  // none: void

/// Everything that is known of a place. Heights are absent where there are none.
struct PointMeasurement {
    geo::LatLon place;
    PointClass kind = PointClass::outside;
    std::optional<geo::OrthometricHeight> H;  ///< above the scene's vertical datum
    std::optional<geo::EllipsoidalHeight> h;  ///< H + N
    /// Of the datum's surface: 0 where H is above the ellipsoid itself. Absent where the datum's geoid is not
    /// in the scene, and outside it.
    std::optional<geo::Undulation> N;
    double resolution_m = 0;    ///< post spacing there, the larger of both axes
    bool filled = false;        ///< H is made of a post that was interpolated over a void
    bool modelled = false;      ///< or of one of a sea bed that was made up
    std::optional<int> source;  ///< of the nearest post, in SceneInfo::sources; none where not recorded

    /// The post nearest to the place in the grid: what the data itself says there.
    struct Post {
        int column = 0;
        int row = 0;
        geo::LatLon place;
        std::optional<double> H_m;  ///< nothing for a void
        double distance_m = 0;      ///< from the place
    };
    std::optional<Post> nearest_post;   ///< nothing outside
    std::optional<SurfaceSlope> slope;  ///< nothing for a void or outside
};

/// Reads a place from the full data: bilinear between posts, the post itself within 1e-6 of one.
/// The class is that of the nearest post; where there is no height, void.
Result<PointMeasurement> measure_point(HeightSampler& sampler, geo::LatLon place);

}  // namespace relevo::lod
