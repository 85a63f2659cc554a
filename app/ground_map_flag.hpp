#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "viewer/ground/ground_map.hpp"

namespace relevo::app {

/// What --ground-map says, for a scene's grid; null without the flag.
Result<std::shared_ptr<const viewer::GroundMap>> read_ground_map(const std::optional<std::string>& file,
                                                                 const geo::GridFrame& frame);

}  // namespace relevo::app
