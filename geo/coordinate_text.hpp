#pragma once

#include <string>
#include <string_view>

#include "geo/position.hpp"
#include "geo/result.hpp"

namespace relevo::geo {

/// Reads a place from text, in any locale: decimal degrees ("37.58,-105.49", "37.58 N 105.49 W"), degrees,
/// minutes and seconds ("37d34'48\"N 105d29'24\"W", also with the signs for degrees and primes), UTM/UPS
/// ("13N 456000 4159000") and MGRS ("13SDB5600059000": the centre of its square). Latitude first. The error
/// says what was expected.
Result<LatLon> parse_lat_lon(std::string_view text);

/// "37.5800000, -105.4900000": decimals after the point; 7 are 1 cm.
std::string to_decimal_degrees(LatLon place, int decimals = 7);
/// 37°34'48.00"N 105°29'24.00"W, seconds with `decimals` digits.
std::string to_dms(LatLon place, int decimals = 2);
/// "13N 456000.00 4159000.00" (UTM), "N 2000000.00 2000000.00" (UPS), metres with `decimals` digits.
std::string to_utm(LatLon place, int decimals = 2);
/// "13SDB5600059000": the metre square that holds the place.
std::string to_mgrs(LatLon place);

}  // namespace relevo::geo
