#pragma once

#include <optional>

#include "lod/scene/scene.hpp"

namespace relevo::lod {

/// N of a scene's vertical datum, for h = H + N: 0 where H is above the ellipsoid itself; nothing where the
/// datum's geoid is not in the scene. \pre the place is in the scene
std::optional<geo::Undulation> known_undulation(const Scene& scene, geo::LatLon place);

}  // namespace relevo::lod
