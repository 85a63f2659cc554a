#pragma once

#include <vector>

#include "geo/position.hpp"

namespace relevo::geo {

/// One zone of UTM, or UPS around a pole.
struct UtmZone {
    int number = 0;  ///< 1 to 60; 0: UPS
    bool north = true;
};

/// The zone that a place is in, with the exceptions of Norway and Svalbard; UPS beyond 84 N and 80 S.
UtmZone utm_zone(LatLon place);

/// A rectangle of longitudes and latitudes, degrees, all of whose places are in one zone.
struct UtmArea {
    UtmZone zone;
    double west = 0;
    double south = 0;
    double east = 0;
    double north = 0;
    /// Is there another zone, or UPS, beyond the side? All along it or nowhere: zones are cut where that
    /// changes, around Norway and Svalbard.
    bool west_is_border = false;
    bool south_is_border = false;
    bool east_is_border = false;
    bool north_is_border = false;
};

/// The areas that together cover a box and more. Longitudes run on across the antimeridian. A zone is one
/// area on both sides of the equator; its zone's `north` is that of its middle.
std::vector<UtmArea> utm_areas(double west, double south, double east, double north);

/// Metres, false origins included.
struct UtmPosition {
    double easting = 0;
    double northing = 0;
};

/// A place in a zone, also in one beside its own: northings run on across the equator. By GeographicLib: 5 nm
/// within 35 degrees of the zone's middle; NaN beyond 60 degrees, where there is no such place.
UtmPosition utm_position(UtmZone zone, LatLon place);

}  // namespace relevo::geo
