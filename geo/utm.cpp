#include "geo/utm.hpp"

#include <cmath>
#include <limits>

#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>

namespace relevo::geo {

UtmZone utm_zone(LatLon place) {
    return {GeographicLib::UTMUPS::StandardZone(place.lat.value, place.lon.value), place.lat.value >= 0};
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
