#pragma once

#include <optional>

#include "geo/position.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// A place in the CRS of a source: easting and northing, or longitude and latitude, in the CRS's own units (x
/// first, whatever the CRS's axis order).
struct SourcePosition {
    double x = 0;
    double y = 0;
};

/// By the coordinate operation that the source came in with; nothing where PROJ has none or the place is
/// outside it.
std::optional<SourcePosition> source_position(const SourceInfo& source, geo::LatLon place);

}  // namespace relevo::lod
