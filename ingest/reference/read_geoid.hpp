#pragma once

#include <filesystem>
#include <optional>

#include "geo/geoid.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"

namespace relevo::ingest {

/// A geoid from a .gtx grid or any raster that GDAL reads on an axis-aligned grid of degrees (GeoTIFF as PROJ
/// has them, .byn, .isg, ...): the first band, metres above the ellipsoid.
/// \param area  where undulations will be asked for, degrees, east above west: of a large grid only that part
///              is read, with enough around it that the spline is the whole grid's to 1e-12
Result<geo::Geoid> read_geoid(const std::filesystem::path& file, const std::optional<Bounds>& area = {});

}  // namespace relevo::ingest
