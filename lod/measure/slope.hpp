#pragma once

#include <optional>

#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// How steep the bilinear surface is at a place, and which way it falls.
struct SurfaceSlope {
    double degrees = 0;  ///< from the level: atan of the rise of H for a metre on the ellipsoid
    std::optional<geo::Degrees>
        aspect;  ///< where it falls to, clockwise from north; nothing where it is level
};

/// The gradient of the cell around the place. On an edge or a post, where cells with other gradients meet, it
/// is the mean of those with heights. Nothing for a void or outside.
Result<std::optional<SurfaceSlope>> surface_slope(HeightSampler& sampler, geo::LatLon place);

}  // namespace relevo::lod
