#include "geo/coordinate_text.hpp"

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "geo/geodesic.hpp"
#include "tests/geo/outside_program.hpp"

namespace relevo::geo {
namespace {

LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

struct Example {
    const char* text;
    double lat;
    double lon;
};

/// Add a line for a format that people write.
constexpr Example kExamples[] = {
    {"37.58,-105.49", 37.58, -105.49},
    {"37.58, -105.49", 37.58, -105.49},
    {"37.58 -105.49", 37.58, -105.49},
    {"  +37.58\t-105.49 ", 37.58, -105.49},
    {"37.58 N 105.49 W", 37.58, -105.49},
    {"37.58N 105.49W", 37.58, -105.49},
    {"37.58n,105.49w", 37.58, -105.49},
    {"N37.58 W105.49", 37.58, -105.49},
    {"N 37.58, W 105.49", 37.58, -105.49},
    {"105.49W 37.58N", 37.58, -105.49},
    {"-33.5 151", -33.5, 151},
    {"33.5S 151E", -33.5, 151},
    {"37d34'48\"N 105d29'24\"W", 37.58, -105.49},
    {"37°34'48\"N 105°29'24\"W", 37.58, -105.49},
    {"37°34′48″N, 105°29′24″W", 37.58, -105.49},
    {"37º34’48”N 105º29’24”W", 37.58, -105.49},
    {"37°34'48''N 105°29'24''W", 37.58, -105.49},
    {"37:34:48 -105:29:24", 37.58, -105.49},
    {"37:34:48N 105:29:24W", 37.58, -105.49},
    {"37 34 48 -105 29 24", 37.58, -105.49},
    {"37 34 48 N 105 29 24 W", 37.58, -105.49},
    {"37 34.8, -105 29.4", 37.58, -105.49},
    {"37d34.8'N 105d29.4'W", 37.58, -105.49},
    {"37° 34.8' N 105° 29.4' W", 37.58, -105.49},
    {"37.58° -105.49°", 37.58, -105.49},
    {"−37.58, −105.49", -37.58, -105.49},
    {"-0 30 0, -0 15", -0.5, -0.25},
    {"90, 0", 90, 0},
    {"-90,180", -90, 180},
    {"0,-180", 0, -180},
    {"0,360", 0, 0},
    {"10, 254.51", 10, -105.49},
    {".5,-.5", 0.5, -0.5},
    {"5.,5.", 5, 5},
};

TEST(ParseLatLon, ReadsWhatPeopleWrite) {
    for (const Example& example : kExamples) {
        const auto place = parse_lat_lon(example.text);
        ASSERT_TRUE(place) << example.text << ": " << place.error().message;
        EXPECT_NEAR(place->lat.value, example.lat, 1e-13) << example.text;
        EXPECT_NEAR(place->lon.value, example.lon, 5e-13) << example.text;
    }
}

TEST(ParseLatLon, RefusesNonsense) {
    for (const auto* const text : {"",
                                   "   ",
                                   ",",
                                   "37.58",
                                   "37.58,",
                                   "37,58,-105,49",
                                   "37,58 -105,49",
                                   "nan,0",
                                   "0,nan",
                                   "inf,0",
                                   "0,-infinity",
                                   "1e1,2",
                                   "0x10,2",
                                   "90.0000001,0",
                                   "-91,0",
                                   "0,361",
                                   "0,-180.5",
                                   "90 0 1N 0E",
                                   "37 60 0, 0",
                                   "37 59 60, 0",
                                   "37.5 30, 0",
                                   "37 -30, 0",
                                   "-37N, 0",
                                   "N37S, 0",
                                   "37N 38N",
                                   "37E 38E",
                                   "1 2 3 4 5",
                                   "1 2 3 4 5 6 7 8",
                                   "37'34, 0",
                                   "37::34, 0",
                                   "37:, 0",
                                   "--37, 0",
                                   "+-37, 0",
                                   "1.2.3, 0",
                                   "., 0",
                                   "here, there",
                                   "INV",
                                   "INV12",
                                   "61N 456000 4159000",
                                   "0N 456000 4159000",
                                   "13T 456000 4159000",
                                   "13N 456000",
                                   "13N 99456000 4159000",
                                   "13N nan 4159000",
                                   "N 2000000 99999999",
                                   "13SDB560005900",
                                   "13SDB5",
                                   "13IDB5600059000",
                                   "99SDB5600059000",
                                   "13SD",
                                   "\xff\xfe"}) {
        const auto place = parse_lat_lon(text);
        EXPECT_FALSE(place) << text;
        if (!place) {
            EXPECT_EQ(place.error().kind, ErrorKind::usage);
        }
    }
    const std::string digits(400, '9');
    EXPECT_FALSE(parse_lat_lon(digits + "," + digits));
}

TEST(ParseLatLon, ErrorSaysWhatWasExpected) {
    const auto place = parse_lat_lon("95,0");
    ASSERT_FALSE(place);
    EXPECT_NE(place.error().message.find("\"95,0\""), std::string::npos);
    EXPECT_NE(place.error().message.find("from -90 to 90"), std::string::npos);
}

TEST(ParseLatLon, ReadsMgrsAsTheMiddleOfItsSquare) {
    const auto coarse = parse_lat_lon("13SDB5659");
    const auto fine = parse_lat_lon("13S DB 56500 59500");
    ASSERT_TRUE(coarse && fine);
    EXPECT_NEAR(geodesic(*coarse, *fine).length_m, std::sqrt(0.5),
                0.01);  // its own middle is half a metre on
    EXPECT_TRUE(parse_lat_lon("13sdb5600059000"));
    EXPECT_TRUE(parse_lat_lon("ZAH0000000000"));  // UPS, the north pole
}

TEST(Text, RoundTripsEverywhere) {
    std::vector<LatLon> places{at(0, 0),          at(-0.0, -0.0), at(90, 0),           at(-90, 0),
                               at(0, 180),        at(0, -180),    at(83.999, 179.999), at(84.1, 5),
                               at(-80.1, -179.9), at(60, 4.5),    at(78, 20.99999),    at(-45, 540)};
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> lat(-90, 90);
    std::uniform_real_distribution<double> lon(-180, 180);
    for (int i = 0; i < 5000; ++i) places.push_back(at(lat(random), lon(random)));
    for (const LatLon& place : places) {
        const auto error_m = [&](const std::string& text) {
            const auto back = parse_lat_lon(text);
            EXPECT_TRUE(back) << text << ": " << back.error().message;
            return back ? geodesic(place, *back).length_m : 1e9;
        };
        EXPECT_LT(error_m(to_decimal_degrees(place)), 0.008);
        EXPECT_LT(error_m(to_decimal_degrees(place, 12)), 1e-6);
        EXPECT_LT(error_m(to_dms(place)), 0.23);
        EXPECT_LT(error_m(to_dms(place, 0)), 23);
        EXPECT_LT(error_m(to_dms(place, 6)), 3e-5);
        EXPECT_LT(error_m(to_utm(place)), 0.0075);
        EXPECT_LT(error_m(to_utm(place, 6)), 1e-6);
        EXPECT_LT(error_m(to_mgrs(place)), 0.72);
    }
}

TEST(Text, IsWhatTheHeaderShows) {
    const LatLon place = at(37.58, -105.49);
    EXPECT_EQ(to_decimal_degrees(place), "37.5800000, -105.4900000");
    EXPECT_EQ(to_decimal_degrees(place, 0), "38, -105");
    EXPECT_EQ(to_dms(place), "37°34'48.00\"N 105°29'24.00\"W");
    EXPECT_EQ(to_utm(at(90, 0)), "N 2000000.00 2000000.00");
    EXPECT_EQ(to_utm(at(0, 3)), "31N 500000.00 0.00");
    EXPECT_EQ(to_mgrs(at(0, 0)), "31NAA6602100000");
}

TEST(Text, SecondsCarry) {
    EXPECT_EQ(to_dms(at(36.9999999999, -104.99999999999)), "37°00'00.00\"N 105°00'00.00\"W");
    EXPECT_EQ(to_dms(at(37 + 59.996 / 3600, 59.994 / 3600)), "37°01'00.00\"N 0°00'59.99\"E");
    EXPECT_EQ(to_dms(at(89.99999999999, 179.9999999999)), "90°00'00.00\"N 180°00'00.00\"E");
    EXPECT_EQ(to_dms(at(1.0 / 3600 / 2, 0), 0), "0°00'01\"N 0°00'00\"E");
}

TEST(Text, HasNoNegativeZero) {
    EXPECT_EQ(to_decimal_degrees(at(-0.0, -0.0)), "0.0000000, 0.0000000");
    EXPECT_EQ(to_decimal_degrees(at(-1e-12, -1e-12)), "0.0000000, 0.0000000");
    EXPECT_EQ(to_decimal_degrees(at(-0.0000001, -20)), "-0.0000001, -20.0000000");
    EXPECT_EQ(to_dms(at(-0.0, -1e-12)), "0°00'00.00\"N 0°00'00.00\"E");
}

TEST(Text, ShowsLongitudesWithin180) {
    EXPECT_EQ(to_decimal_degrees(at(0, 180), 1), "0.0, 180.0");
    EXPECT_EQ(to_decimal_degrees(at(0, -180), 1), "0.0, -180.0");
    EXPECT_EQ(to_decimal_degrees(at(0, 180.5), 1), "0.0, -179.5");
    EXPECT_EQ(to_decimal_degrees(at(0, -190), 1), "0.0, 170.0");
}

TEST(Text, EqualsGeoConvert) {
    std::vector<LatLon> places{at(37.58, -105.49), at(84.5, 30), at(-88, -120),
                               at(60, 4.5),        at(78, 20.9), at(-33.9, 151.2)};
    std::vector<std::string> input;
    for (const LatLon& p : places) input.push_back(fmt::format("{} {}", p.lat.value, p.lon.value));
    const auto mgrs = test::ask("GeoConvert -m -p 0", input);
    const auto utm = test::ask("GeoConvert -u -p 2", input);
    if (mgrs.size() != places.size())
        GTEST_SKIP() << "GeoConvert is not installed (package geographiclib-tools)";
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(to_mgrs(places[i]), mgrs[i]);
        std::string expected = utm[i];
        for (char& c : expected) c = c == 'n' ? 'N' : c == 's' ? 'S' : c;
        EXPECT_EQ(to_utm(places[i]), expected);
    }
}

/// Decimal comma and dots between thousands, as in German.
class Commas : public std::numpunct<char> {
  protected:
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

void expect_the_same_as_anywhere() {
    for (const Example& example : kExamples) {
        const auto place = parse_lat_lon(example.text);
        ASSERT_TRUE(place) << example.text;
        EXPECT_NEAR(place->lat.value, example.lat, 1e-13) << example.text;
        EXPECT_NEAR(place->lon.value, example.lon, 5e-13) << example.text;
    }
    const LatLon place = at(37.58, -105.49);
    EXPECT_EQ(to_decimal_degrees(place), "37.5800000, -105.4900000");
    EXPECT_EQ(to_dms(place), "37°34'48.00\"N 105°29'24.00\"W");
    EXPECT_EQ(to_utm(at(0, 3)), "31N 500000.00 0.00");
    EXPECT_EQ(to_mgrs(at(0, 0)), "31NAA6602100000");
    EXPECT_TRUE(parse_lat_lon(to_mgrs(place)));
}

TEST(Locale, OfCppChangesNothing) {
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Commas));
    expect_the_same_as_anywhere();
    std::locale::global(before);
}

TEST(Locale, OfCChangesNothing) {
    // A real comma locale, made for the test where the machine can.
    const test::ScratchFolder scratch("locale");
    const auto made = scratch / "de_DE.UTF-8";
    const std::string make =
        fmt::format("localedef --no-archive -i de_DE -f UTF-8 '{}' >/dev/null 2>&1", made.string());
    if (std::system(make.c_str()) != 0) GTEST_SKIP() << "localedef cannot make de_DE here (package locales)";
    setenv("LOCPATH", made.parent_path().c_str(), 1);
    const bool set = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    unsetenv("LOCPATH");
    ASSERT_TRUE(set);
    ASSERT_EQ(std::string(std::localeconv()->decimal_point), ",");
    expect_the_same_as_anywhere();
    std::setlocale(LC_ALL, "C");
}

}  // namespace
}  // namespace relevo::geo
