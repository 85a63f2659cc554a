#pragma once

#include <string>
#include <string_view>

#include "geo/result.hpp"
#include "geo/sun.hpp"

namespace relevo::viewer {

/// Where the light comes from, as a user says it.
struct SunSetting {
    enum class Kind {
        automatic,  ///< from the north-west, 45 degrees high, everywhere: what maps have
        direction,  ///< an azimuth and an elevation, the same everywhere
        time,       ///< where the sun stands at that time: it differs over the earth
    };
    Kind kind = Kind::automatic;
    geo::SunDirection direction{geo::Degrees{315}, geo::Degrees{45}};  ///< automatic and direction
    double julian_day = 0;                                             ///< time
    std::string text = "auto";                                         ///< as it was given
};

/// Reads "auto", "AZIMUTH,ELEVATION" in degrees, or an ISO 8601 time.
Result<SunSetting> parse_sun(std::string_view text);

/// The sun's direction at a place.
geo::SunDirection sun_at(const SunSetting& setting, geo::LatLon place);

}  // namespace relevo::viewer
