#pragma once

#include <string_view>

#include "geo/position.hpp"
#include "geo/result.hpp"

namespace relevo::geo {

/// Where the sun stands: azimuth clockwise from north, elevation above the horizon (negative at night).
struct SunDirection {
    Degrees azimuth;
    Degrees elevation;
};

/// The sun at a place and a time, to 0.02 degrees from 1950 to 2050 (Astronomical Almanac, low-precision
/// formulas); no refraction.
SunDirection sun_at(LatLon place, double julian_day_utc);

/// The Julian day of an ISO 8601 time: "2026-06-21T12:00:00Z", with "Z", an offset ("+02:00") or nothing
/// (UTC).
Result<double> parse_iso_time(std::string_view text);

}  // namespace relevo::geo
