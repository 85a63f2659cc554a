#include "geo/sun.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace relevo::geo {
namespace {

LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

double day(std::string_view text) {
    const auto parsed = parse_iso_time(text);
    EXPECT_TRUE(parsed) << text;
    return parsed ? *parsed : 0;
}

TEST(Sun, StandsAtMeeusExampleDeclination) {
    // Meeus, Astronomical Algorithms, example 25.a: 1992-10-13 0h TD, declination -7.78507 degrees. From the
    // pole the elevation is the declination. (TD is 59 s ahead of UTC then: 0.0003 degrees.)
    EXPECT_NEAR(sun_at(at(90, 0), 2448908.5).elevation.value, -7.78507, 0.01);
}

TEST(Sun, StandsAtNrelExample) {
    // NREL/TP-560-34302 (SPA), example: 2003-10-17 12:30:30 at UTC-7, 39.742476 N 105.1786 W: azimuth
    // 194.34024, zenith 50.11162 with a refraction of 0.0162 and a parallax of 0.0019 degrees.
    const auto sun = sun_at(at(39.742476, -105.1786), day("2003-10-17T12:30:30-07:00"));
    EXPECT_NEAR(sun.azimuth.value, 194.34024, 0.02);
    EXPECT_NEAR(sun.elevation.value, 90 - 50.11162 - 0.0162 + 0.0019, 0.02);
}

TEST(Sun, SolsticesAndEquinoxes) {
    // Instants from the US Naval Observatory, 2020.
    EXPECT_NEAR(sun_at(at(90, 0), day("2020-06-20T21:44Z")).elevation.value, 23.4366, 0.01);
    EXPECT_NEAR(sun_at(at(90, 0), day("2020-12-21T10:02Z")).elevation.value, -23.4366, 0.01);
    EXPECT_NEAR(sun_at(at(90, 0), day("2020-03-20T03:50Z")).elevation.value, 0, 0.02);
    EXPECT_NEAR(sun_at(at(-90, 0), day("2020-09-22T13:31Z")).elevation.value, 0, 0.02);
}

TEST(Sun, NoonElevationIsColatitudePlusDeclination) {
    for (const double lat : {-60.0, -23.0, 0.0, 37.5, 66.0}) {
        double highest = -90;
        SunDirection noon;
        for (int minute = 0; minute < 1440; ++minute) {
            const auto sun = sun_at(at(lat, -105), day("2024-04-10T00:00Z") + minute / 1440.0);
            if (sun.elevation.value > highest) {
                highest = sun.elevation.value;
                noon = sun;
            }
        }
        const double declination = sun_at(at(90, 0), day("2024-04-10T19:00Z")).elevation.value;
        EXPECT_NEAR(highest, 90 - std::abs(lat - declination), 0.02);
        EXPECT_NEAR(std::abs(std::remainder(noon.azimuth.value - (lat > declination ? 180 : 0), 360)), 0, 2);
    }
}

TEST(Sun, RisesInTheEastAndIsTheSameFromEitherName) {
    EXPECT_NEAR(sun_at(at(0, 0), day("2020-03-20T06:00Z")).azimuth.value, 90, 1);
    EXPECT_NEAR(sun_at(at(0, 0), day("2020-03-20T18:00Z")).azimuth.value, 270, 1);
    const auto west = sun_at(at(10, -170), 2459000.25);
    const auto east = sun_at(at(10, 190), 2459000.25);
    EXPECT_NEAR(west.azimuth.value, east.azimuth.value, 1e-9);
    EXPECT_NEAR(west.elevation.value, east.elevation.value, 1e-9);
}

TEST(IsoTime, IsRead) {
    EXPECT_DOUBLE_EQ(day("2000-01-01T12:00:00Z"), 2451545.0);
    EXPECT_DOUBLE_EQ(day("2000-01-01T12:00"), 2451545.0);
    EXPECT_DOUBLE_EQ(day("2000-01-01 14:00:00+02:00"), 2451545.0);
    EXPECT_DOUBLE_EQ(day("2000-01-01T07:00-0500"), 2451545.0);
    EXPECT_DOUBLE_EQ(day("2000-01-02T02:00+14"), 2451545.0);
    EXPECT_DOUBLE_EQ(day("1858-11-17"), 2400000.5);
    EXPECT_NEAR((day("2024-02-29T00:00:01.5Z") - day("2024-02-29")) * 86400, 1.5, 1e-4);
}

TEST(IsoTime, NonsenseIsRefused) {
    for (const auto* const text :
         {"", "noon", "2024", "2024-13-01", "2023-02-29", "2024-02-30T00:00Z", "2024-01-01T24:00Z",
          "2024-01-01T12:60Z", "2024-01-01T12:00:60.5", "2024-01-01T12", "2024-01-01T12:00:00.Z",
          "2024-01-01T12:00+25:00", "2024-01-01T12:00X", "2024-01-01T12:00Z ", "-024-01-01", "2024-01-01Z"})
        EXPECT_FALSE(parse_iso_time(text)) << text;
}

}  // namespace
}  // namespace relevo::geo
