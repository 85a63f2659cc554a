#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "geo/result.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/scene/scene_info.hpp"
#include "viewer/eye_height.hpp"
#include "viewer/ground/drape.hpp"
#include "viewer/ground/ground_map.hpp"

namespace relevo::viewer {

/// What pictures need to know of a terrain as a whole.
struct GroundFacts {
    double lowest_m = 0;  ///< H of the data; both 0 where all is void
    double highest_m = 0;
    double lowest_land_m = 0;  ///< of what is not sea; at most highest_m
    bool has_voids = false;
    bool has_sea = false;
    bool sea_is_level = false;  ///< the data has no bed under its sea, but heights of 0
};

/// Definitions for shaders that read heights from the pages.
std::string height_defines(const GroundFacts& facts);

/// Of a scene, from what its scene.json says. Of its land next to sea it says the lowest only where that is
/// below 0: else 0 is taken.
GroundFacts ground_facts(const lod::SceneInfo& info);

/// Of a pyramid, by reading all of its finest level.
Result<GroundFacts> ground_facts(const lod::Pyramid& pyramid);

/// Where pictures of a terrain have its ground from.
struct GroundData {
    const lod::Pyramid* pyramid = nullptr;  ///< must outlive what draws
    GroundFacts facts = {};
    std::size_t cache_bytes = std::size_t{192} << 20;  ///< of textures; a few pages at least
    /// N anywhere on earth, for the sea's level, which is at the ellipsoid without it. Must outlive what
    /// draws.
    const EyeHeight* heights = nullptr;
    /// What the layer `terrain` is made of, where the user says it.
    std::shared_ptr<const GroundMap> map = nullptr;
    /// What overlays drape over it, by their number of a file; it takes half of cache_bytes. At most
    /// kMostDrapes.
    Drapes drapes = {};
    static constexpr std::size_t kMostDrapes = 4;
    /// Called once for each block that cannot be read, on the thread that draws.
    std::function<void(const std::string&)> report = [](const std::string&) {};
};

}  // namespace relevo::viewer
