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

// Every place of a box is in one area, whose zone is GeographicLib's; borders are where the zone changes.
TEST(UtmAreas, CoverABoxByItsZones) {
    std::mt19937_64 random(6);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    for (int box = 0; box < 40; ++box) {
        const double west = box < 10 ? any(-5, 5) : any(-400, 300);
        const double south = box < 10 ? any(50, 70) : any(-90, 80);
        const double east = west + any(0.1, 60);
        const double north = std::min(south + any(0.1, 60), 90.0);
        const auto areas = utm_areas(west, south, east, north);
        for (int i = 0; i < 200; ++i) {
            const double lat = any(south, north);
            const double lon = any(west, east);
            int inside = 0;
            for (const UtmArea& area : areas) {
                if (lon < area.west || lon >= area.east || lat < area.south || lat >= area.north) continue;
                ++inside;
                ASSERT_EQ(area.zone.number, utm_zone(at(lat, lon)).number) << lat << " " << lon;
            }
            ASSERT_EQ(inside, 1) << lat << " " << lon;
        }
        constexpr double kBeside = 1e-6;
        for (const UtmArea& area : areas) {
            for (int i = 0; i < 10; ++i) {
                const double lat = any(area.south, area.north);
                const double lon = any(area.west, area.east);
                const int zone = area.zone.number;
                EXPECT_EQ(area.west_is_border, utm_zone(at(lat, area.west - kBeside)).number != zone);
                EXPECT_EQ(area.east_is_border, utm_zone(at(lat, area.east + kBeside)).number != zone);
                if (area.south > -90) {
                    EXPECT_EQ(area.south_is_border, utm_zone(at(area.south - kBeside, lon)).number != zone);
                }
                if (area.north < 90) {
                    EXPECT_EQ(area.north_is_border, utm_zone(at(area.north + kBeside, lon)).number != zone);
                }
            }
        }
    }
    // Norway's part of zone 31 is half as wide, Svalbard has no zone 32.
    const auto norway = utm_areas(0.1, 60, 2.9, 60.1);
    ASSERT_EQ(norway.size(), 1U);
    EXPECT_EQ(norway[0].east, 3);
    for (const UtmArea& area : utm_areas(0, 75, 30, 76)) EXPECT_NE(area.zone.number, 32);
}

}  // namespace
}  // namespace relevo::geo
