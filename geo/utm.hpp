#pragma once

#include "geo/position.hpp"

namespace relevo::geo {

/// One zone of UTM, or UPS around a pole.
struct UtmZone {
    int number = 0;  ///< 1 to 60; 0: UPS
    bool north = true;
};

/// The zone that a place is in, with the exceptions of Norway and Svalbard; UPS beyond 84 N and 80 S.
UtmZone utm_zone(LatLon place);

/// Metres, false origins included.
struct UtmPosition {
    double easting = 0;
    double northing = 0;
};

/// A place in a zone, also in one beside its own: northings run on across the equator. By GeographicLib: 5 nm
/// within 35 degrees of the zone's middle; NaN beyond 60 degrees, where there is no such place.
UtmPosition utm_position(UtmZone zone, LatLon place);

}  // namespace relevo::geo
