#pragma once

#include <memory>
#include <string_view>

#include "geo/result.hpp"
#include "lod/ocean/wave_map.hpp"
#include "lod/ocean/wind_sea.hpp"

namespace relevo::viewer {

/// Which mesh the sea is drawn with.
enum class OceanKind {
    automatic,   ///< the one that costs least for its error (docs/ocean.md)
    geoclipmap,  ///< squares of blocks around the eye, on a lattice that is fixed to the earth
    radial,      ///< rings around the eye
    projected,   ///< a grid of the screen, projected onto the sea
    off,         ///< none: sea is ground of another colour
};
std::string_view to_string(OceanKind kind);
Result<OceanKind> parse_ocean(std::string_view text);

/// How the sea looks.
struct OceanSettings {
    OceanKind kind = OceanKind::automatic;
    lod::Wind wind{.speed_m_s = 6, .from = geo::Degrees{300}};
    /// Waves of a map instead of the wind's, which then only roughens them. Null: the wind's.
    std::shared_ptr<const lod::WaveMap> map = nullptr;
    double time_s = 0;    ///< of the waves
    double error_px = 1;  ///< most that the drawn surface is off the waves
};

/// "SPEED,FROM": metres a second, 0 to 40, and degrees; FROM may be left out.
Result<lod::Wind> parse_wind(std::string_view text);

}  // namespace relevo::viewer
