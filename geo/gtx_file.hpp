#pragma once

#include <filesystem>

#include "geo/geoid_nodes.hpp"
#include "geo/result.hpp"

namespace relevo::geo {

/// The nodes of a grid in NOAA's .gtx format (big-endian; of a region or of the whole earth).
Result<GeoidNodes> read_gtx(const std::filesystem::path& file);

}  // namespace relevo::geo
