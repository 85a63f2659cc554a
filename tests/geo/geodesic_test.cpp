#include "geo/geodesic.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "geo/ellipsoid.hpp"
#include "tests/geo/outside_program.hpp"

namespace relevo::geo {
namespace {

LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

/// Meridian quadrant of WGS 84 (Karney 2011), metres.
constexpr double kQuadrant = 10001965.729312723;

TEST(Geodesic, ClosedForms) {
    // Along the equator, from pole to pole, from the equator to a pole.
    EXPECT_NEAR(geodesic(at(0, 10), at(0, 11)).length_m, wgs84::kSemiMajor * std::numbers::pi / 180, 1e-8);
    EXPECT_NEAR(geodesic(at(90, 0), at(-90, 0)).length_m, 2 * kQuadrant, 2e-8);
    EXPECT_NEAR(geodesic(at(0, -75), at(90, 12)).length_m, kQuadrant, 1e-8);
    EXPECT_NEAR(geodesic(at(89, 0), at(89, 180)).length_m, 2 * geodesic(at(89, 0), at(90, 0)).length_m, 1e-8);
    // The antipode on the equator is reached over a pole.
    EXPECT_NEAR(geodesic(at(0, 0), at(0, 180)).length_m, 2 * kQuadrant, 2e-8);
    EXPECT_EQ(geodesic(at(12, 34), at(12, 34)).length_m, 0);
}

TEST(Geodesic, AzimuthsAreInTheWholeCircle) {
    EXPECT_EQ(geodesic(at(0, 0), at(0, 1)).azimuth1.value, 90);
    EXPECT_EQ(geodesic(at(0, 1), at(0, 0)).azimuth1.value, 270);
    EXPECT_EQ(geodesic(at(0, 0), at(1, 0)).azimuth1.value, 0);
    EXPECT_EQ(geodesic(at(1, 0), at(0, 0)).azimuth1.value, 180);
    EXPECT_EQ(geodesic(at(0, 179.5), at(0, -179.5)).azimuth1.value, 90);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> lat(-90, 90);
    std::uniform_real_distribution<double> lon(-180, 180);
    for (int i = 0; i < 1000; ++i) {
        const auto line = geodesic(at(lat(random), lon(random)), at(lat(random), lon(random)));
        for (const Degrees azimuth : {line.azimuth1, line.azimuth2}) {
            EXPECT_GE(azimuth.value, 0);
            EXPECT_LT(azimuth.value, 360);
        }
    }
}

TEST(Geodesic, EqualsGeodSolve) {
    std::vector<std::array<double, 4>> pairs{{0, 0, 0, 179.5},
                                             {0, 0, 0.5, 179.5},
                                             {0, 0, 0.5, 179.7},
                                             {89.9999, 10, -89.9999, -170},
                                             {45, 179.999, 45, -179.999},
                                             {83.9, 0, 83.9, 1e-7},
                                             {37.5, -105.5, 37.5, -105.5},
                                             {30, 0, -30, 180},
                                             {-90, 0, 90, 77},
                                             {1e-10, 0, -1e-10, 1e-10}};
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> lat(-90, 90);
    std::uniform_real_distribution<double> lon(-180, 180);
    std::uniform_real_distribution<double> near(-0.01, 0.01);
    for (int i = 0; i < 1000; ++i) {
        const double lat1 = lat(random) * 0.99;
        const double lon1 = lon(random);
        pairs.push_back({lat1, lon1, lat(random), lon(random)});
        pairs.push_back({lat1, lon1, lat1 + near(random), lon1 + near(random)});
    }
    std::vector<std::string> input;
    for (const auto& p : pairs)
        input.push_back(fmt::format("{:.20f} {:.20f} {:.20f} {:.20f}", p[0], p[1], p[2], p[3]));
    const auto answers = test::ask("GeodSolve -i -p 10", input);
    if (answers.size() != pairs.size())
        GTEST_SKIP() << "GeodSolve is not installed (package geographiclib-tools)";
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto expected = test::numbers(answers[i]);  // azimuth1, azimuth2, length
        const auto line = geodesic(at(pairs[i][0], pairs[i][1]), at(pairs[i][2], pairs[i][3]));
        ASSERT_EQ(expected.size(), 3U) << answers[i];
        EXPECT_NEAR(line.length_m, expected[2], 1e-8) << input[i];
        EXPECT_NEAR(std::remainder(line.azimuth1.value - expected[0], 360), 0, 1e-9) << input[i];
        EXPECT_NEAR(std::remainder(line.azimuth2.value - expected[1], 360), 0, 1e-9) << input[i];
    }
}

TEST(Geodesic, DestinationAndPathAgreeWithTheLine) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> lat(-89, 89);
    std::uniform_real_distribution<double> lon(-180, 180);
    for (int i = 0; i < 500; ++i) {
        const LatLon from = at(lat(random), lon(random));
        const LatLon to = at(lat(random), lon(random));
        const auto line = geodesic(from, to);
        EXPECT_LT(geodesic(geodesic_destination(from, line.azimuth1, line.length_m), to).length_m, 5e-8);
        const GeodesicPath path(from, to);
        EXPECT_EQ(path.length_m(), line.length_m);
        for (const double part : {0.0, 0.3, 1.0}) {
            const double distance = part * path.length_m();
            const LatLon there = path.at(distance);
            EXPECT_LT(geodesic(there, geodesic_destination(from, line.azimuth1, distance)).length_m, 5e-8);
        }
        EXPECT_NEAR(std::remainder(path.azimuth(path.length_m()).value - line.azimuth2.value, 360), 0, 1e-6);
    }
}

TEST(Geodesic, PathRunsOnAcrossTheAntimeridian) {
    const GeodesicPath path(at(-16, 179), at(-17, -179));
    double last = 179;
    for (int i = 1; i <= 100; ++i) {
        const double lon = path.at(path.length_m() * i / 100).lon.value;
        EXPECT_GT(lon, last);
        EXPECT_LT(lon - last, 0.03);
        last = lon;
    }
    EXPECT_NEAR(last, 181, 1e-9);
}

TEST(GeodesicArea, IsThatOfTheSmallerPartWhateverTheDirection) {
    constexpr double kEarth = 510065621724088.5;  // m2, the ellipsoid
    const std::array octant{at(0, 0), at(0, 90), at(90, 0)};
    const std::array backwards{at(90, 0), at(0, 90), at(0, 0)};
    EXPECT_NEAR(geodesic_area(octant).area_m2, kEarth / 8, 1);
    EXPECT_NEAR(geodesic_area(backwards).area_m2, kEarth / 8, 1);
    EXPECT_NEAR(geodesic_area(octant).perimeter_m, 2 * kQuadrant + wgs84::kSemiMajor * std::numbers::pi / 2,
                1e-7);
    // Round a pole, and across the antimeridian.
    const std::array cap{at(80, 0), at(80, 90), at(80, 180), at(80, 270)};
    EXPECT_GT(geodesic_area(cap).area_m2, 1e12);
    EXPECT_LT(geodesic_area(cap).area_m2, 5e12);
    const std::array here{at(10, 20), at(10, 21), at(11, 21), at(11, 20)};
    const std::array there{at(10, 179.5), at(10, -179.5), at(11, -179.5), at(11, 179.5)};
    EXPECT_NEAR(geodesic_area(here).area_m2, geodesic_area(there).area_m2, 0.1);
}

}  // namespace
}  // namespace relevo::geo
