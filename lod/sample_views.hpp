#pragma once

#include <cstdint>
#include <vector>

#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Cameras spread over a terrain that try its meshes in every way: straight down, down at a slant, along the
/// ground and along the horizon, from 2 m above the ground to far above the whole terrain. The same seed
/// gives the same cameras. \pre the terrain has a valid post
std::vector<Camera> sample_views(const Terrain& terrain, int count, std::uint64_t seed, int width,
                                 int height);

}  // namespace relevo::lod
