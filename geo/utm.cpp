#include "geo/utm.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>

namespace relevo::geo {

UtmZone utm_zone(LatLon place) {
    return {GeographicLib::UTMUPS::StandardZone(place.lat.value, place.lon.value), place.lat.value >= 0};
}

std::vector<UtmArea> utm_areas(double west, double south, double east, double north) {
    // Where zones begin and end: at these latitudes, and at longitudes that are multiples of three degrees.
    static constexpr std::array<double, 7> kCuts{-90, -80, 56, 64, 72, 84, 90};
    constexpr double kCell = 3;
    const auto zone_at = [](double lat, double lon) { return utm_zone({Degrees{lat}, Degrees{lon}}).number; };
    const auto middle = [](std::size_t strip) { return 0.5 * (kCuts[strip] + kCuts[strip + 1]); };
    std::vector<UtmArea> areas;
    for (std::size_t strip = 0; strip + 1 < kCuts.size(); ++strip) {
        if (kCuts[strip + 1] < south || kCuts[strip] > north) continue;
        const double lat = middle(strip);
        const auto below = [&](double lon) { return strip == 0 ? 0 : zone_at(middle(strip - 1), lon); };
        const auto above = [&](double lon) {
            return strip + 2 == kCuts.size() ? 0 : zone_at(middle(strip + 1), lon);
        };
        // The first and the last may be less than a zone: there they have no border.
        double lon = 6 * std::floor(west / 6);
        while (lon < east) {
            const double here = lon + 0.5 * kCell;
            const int zone = zone_at(lat, here);
            UtmArea area{{zone, lat >= 0}, lon, kCuts[strip], lon + kCell, kCuts[strip + 1]};
            area.south_is_border = strip > 0 && below(here) != zone;
            area.north_is_border = strip + 2 < kCuts.size() && above(here) != zone;
            const auto goes_on = [&](double next) {
                return zone_at(lat, next) == zone && (below(next) != zone) == (below(here) != zone) &&
                       (above(next) != zone) == (above(here) != zone);
            };
            while (area.east < east + 6 && area.east - lon < 360 && goes_on(area.east + 0.5 * kCell))
                area.east += kCell;
            area.west_is_border = zone_at(lat, lon - 0.5 * kCell) != zone;
            area.east_is_border = zone_at(lat, area.east + 0.5 * kCell) != zone;
            lon = area.east;
            areas.push_back(area);
        }
    }
    return areas;
}

UtmPosition utm_position(UtmZone zone, LatLon place) {
    // Of the projections themselves: GeographicLib's UTMUPS throws at places that are not near their zone.
    UtmPosition at;
    if (zone.number == 0) {
        GeographicLib::PolarStereographic::UPS().Forward(zone.north, place.lat.value, place.lon.value,
                                                         at.easting, at.northing);
        return {at.easting + 2e6, at.northing + 2e6};
    }
    const double middle = 6 * zone.number - 183;
    if (std::abs(std::remainder(place.lon.value - middle, 360.0)) > 60) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        return {kNone, kNone};
    }
    GeographicLib::TransverseMercator::UTM().Forward(middle, place.lat.value, place.lon.value, at.easting,
                                                     at.northing);
    return {at.easting + 5e5, at.northing + (zone.north ? 0 : 1e7)};
}

}  // namespace relevo::geo
