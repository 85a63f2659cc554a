#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/geoid.hpp"
#include "geo/result.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// The file of a geoid's nodes: a GeoTIFF of floats, north up, void = NaN.
Result<std::vector<std::byte>> encode_geoid(const geo::GeoidNodes& nodes);

/// The geoid in the bytes of such a file. \param name  for the message; fails with ErrorKind::damaged
Result<geo::Geoid> decode_geoid(std::span<const std::byte> bytes, const GeoidInfo& info,
                                const std::string& name);

}  // namespace relevo::lod
