#pragma once

#include <array>

#include <glm/vec4.hpp>

#include "lod/ocean/sea_view.hpp"
#include "lod/ocean/waves.hpp"
#include "lod/terrain.hpp"
#include "viewer/ocean/ocean_settings.hpp"
#include "viewer/ocean/ripples.hpp"
#include "viewer/sun_setting.hpp"

namespace relevo::viewer {

/// The uniform block of shaders/ocean.glsl.
struct OceanBlock {
    glm::vec4 anchor_east, anchor_north, anchor_up;
    glm::vec4 nadir_up, nadir_east, nadir_north;
    glm::vec4 level;
    glm::vec4 grid;
    glm::vec4 sun;
    glm::vec4 slopes;
    std::array<glm::vec4, Ripples::kLayers> ripples, steepest;
    std::array<glm::vec4, std::size_t{2} * lod::Waves::kComponents> waves;
};

/// \param sea_h_m  height of the sea above the ellipsoid at the nadir
/// \param reach    of the undulation's outermost texel from its texture's middle, in parts of the texture
OceanBlock ocean_block(const lod::SeaView& sea, double sea_h_m, double reach, const lod::Waves& waves,
                       const Ripples& ripples, const lod::Terrain& terrain, const OceanSettings& settings,
                       const SunSetting& sun);

}  // namespace relevo::viewer
