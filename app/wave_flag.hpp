#pragma once

#include <memory>
#include <string>

#include "geo/angle.hpp"
#include "geo/result.hpp"
#include "lod/ocean/wave_map.hpp"

namespace relevo::app {

/// Reads what --waves names: MAP[,TILE_M[,HEIGHT_M]]. Where the map is resampled, says so on stderr.
Result<std::shared_ptr<const lod::WaveMap>> read_waves(const std::string& text, geo::Degrees wind_from);

}  // namespace relevo::app
