#include "geo/coordinate_text.hpp"

#include <cassert>
#include <cmath>
#include <cstdint>

#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <fmt/format.h>

namespace relevo::geo {
namespace {

[[maybe_unused]] bool is_place(LatLon place) {
    return std::abs(place.lat.value) <= 90 && std::isfinite(place.lon.value);
}

/// The longitude as people write it: in [-180, 180], 180 itself kept.
double shown_longitude(Degrees lon) {
    return std::remainder(lon.value, 360.0);
}

/// A number with so many decimals, never "-0.00".
std::string fixed(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.front() == '-' && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
    return text;
}

std::string dms(double degrees, int decimals, char positive, char negative) {
    // Rounded once, as a whole number of the last digit's units: 59.9999" carries into the minutes.
    const auto units = static_cast<std::int64_t>(std::pow(10.0, decimals));
    const std::int64_t total = std::llround(std::abs(degrees) * 3600 * static_cast<double>(units));
    const std::int64_t seconds = total / units;
    std::string text = fmt::format("{}°{:02}'{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
    if (decimals > 0) text += fmt::format(".{:0{}}", total % units, decimals);
    return text + '"' + (degrees < 0 && total != 0 ? negative : positive);
}

struct Projected {
    int zone = 0;  // 0: UPS
    bool north = true;
    double easting = 0;
    double northing = 0;
};

Projected project(LatLon place) {
    Projected p;
    GeographicLib::UTMUPS::Forward(place.lat.value, place.lon.value, p.zone, p.north, p.easting, p.northing);
    return p;
}

}  // namespace

std::string to_decimal_degrees(LatLon place, int decimals) {
    assert(is_place(place) && decimals >= 0);
    return fixed(place.lat.value, decimals) + ", " + fixed(shown_longitude(place.lon), decimals);
}

std::string to_dms(LatLon place, int decimals) {
    assert(is_place(place) && decimals >= 0 && decimals <= 10);
    return dms(place.lat.value, decimals, 'N', 'S') + ' ' +
           dms(shown_longitude(place.lon), decimals, 'E', 'W');
}

std::string to_utm(LatLon place, int decimals) {
    assert(is_place(place) && decimals >= 0);
    const Projected p = project(place);
    const char hemisphere = p.north ? 'N' : 'S';
    const std::string metres = fixed(p.easting, decimals) + ' ' + fixed(p.northing, decimals);
    return p.zone == 0 ? fmt::format("{} {}", hemisphere, metres)
                       : fmt::format("{}{} {}", p.zone, hemisphere, metres);
}

std::string to_mgrs(LatLon place) {
    assert(is_place(place));
    constexpr int kMetreDigits = 5;
    const Projected p = project(place);
    std::string text;
    GeographicLib::MGRS::Forward(p.zone, p.north, p.easting, p.northing, place.lat.value, kMetreDigits, text);
    return text;
}

}  // namespace relevo::geo
