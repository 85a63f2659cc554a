#include "geo/utm.hpp"

#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geo/coordinate_text.hpp"

namespace relevo::geo {
namespace {

LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

// Truth: to_utm, which is GeographicLib's UTMUPS, in the zone that a place is in.
TEST(Utm, AgreesWithTheTextOfPlaces) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 2000; ++i) {
        const auto place = at(std::uniform_real_distribution<>(-90, 90)(random),
                              std::uniform_real_distribution<>(-180, 180)(random));
        const UtmZone zone = utm_zone(place);
        const UtmPosition made = utm_position(zone, place);
        const std::string head = zone.number == 0 ? (zone.north ? "N" : "S")
                                                  : fmt::format("{}{}", zone.number, zone.north ? 'N' : 'S');
        EXPECT_EQ(fmt::format("{} {:.3f} {:.3f}", head, made.easting, made.northing), to_utm(place, 3));
    }
}

TEST(Utm, RunsOnBeyondItsZoneAndAcrossTheEquator) {
    EXPECT_EQ(utm_zone(at(60, 5)).number, 32);   // Norway
    EXPECT_EQ(utm_zone(at(75, 10)).number, 33);  // Svalbard
    EXPECT_NEAR(utm_position({32, true}, at(-1e-6, 9)).northing, -0.11, 0.01);
    EXPECT_NEAR(utm_position({32, false}, at(-1e-6, 9)).northing, 1e7 - 0.11, 0.01);
    EXPECT_NEAR(utm_position({60, true}, at(0, -179)).easting, 500e3 + 445.3e3, 500);  // from 177 E
    EXPECT_TRUE(std::isnan(utm_position({32, true}, at(0, 100)).easting));
}

}  // namespace
}  // namespace relevo::geo
