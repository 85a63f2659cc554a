#include "geo/antimeridian.hpp"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "geo/geodesic.hpp"

namespace relevo::geo {
namespace {

using Places = std::vector<LatLon>;

LatLon at(double lat, double lon) {
    return {Degrees{lat}, Degrees{lon}};
}

double area_of(const std::vector<Places>& parts) {
    double sum = 0;
    for (const Places& part : parts) sum += geodesic_area(part).area_m2;
    return sum;
}

/// Plane sides never jump over more than half the earth, and longitudes are those of a file.
void expect_writable(const std::vector<Places>& parts) {
    for (const Places& part : parts) {
        for (const LatLon& place : part) EXPECT_LE(std::abs(place.lon.value), 180);
        for (std::size_t i = 1; i < part.size(); ++i) {
            const bool along_pole =
                std::abs(part[i].lat.value) == 90 && std::abs(part[i - 1].lat.value) == 90;
            EXPECT_TRUE(along_pole || std::abs((part[i].lon - part[i - 1].lon).value) <= 180);
        }
    }
}

TEST(Antimeridian, WhatDoesNotCrossStaysAsItIs) {
    const Places path{at(10, 20), at(11, 21.1), at(-7, -100)};
    const auto parts = split_path(path);
    ASSERT_EQ(parts.size(), 1u);
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_EQ(parts[0][i].lat, path[i].lat);
        EXPECT_EQ(parts[0][i].lon, path[i].lon);
    }
    const Places ring{at(10, 20), at(10, 21), at(11, 21)};
    ASSERT_EQ(split_polygon(ring).size(), 1u);
    EXPECT_EQ(split_polygon(ring)[0][2].lat.value, 11);
}

TEST(Antimeridian, APathIsSplitOnTheGeodesic) {
    const Places path{at(50, 170), at(52, -170), at(40, 175), at(41, 178)};
    const auto parts = split_path(path);
    ASSERT_EQ(parts.size(), 3u);
    expect_writable(parts);
    EXPECT_EQ(parts[0].back().lon.value, 180);
    EXPECT_EQ(parts[1].front().lon.value, -180);
    EXPECT_EQ(parts[0].back().lat, parts[1].front().lat);
    const double whole = geodesic(path[0], path[1]).length_m;
    EXPECT_NEAR(geodesic(path[0], parts[0].back()).length_m + geodesic(parts[1].front(), path[1]).length_m,
                whole, 1e-8);
    EXPECT_GT(parts[0].back().lat.value, 51.2);  // a straight line in degrees would be at 51
}

TEST(Antimeridian, AVertexOnItIsSplitThere) {
    const auto parts = split_path(Places{at(1, 179), at(2, 180), at(3, -179)});
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].back().lon.value, 180);
    EXPECT_EQ(parts[1].front().lon.value, -180);
    EXPECT_EQ(parts[0].size() + parts[1].size(), 4u);
    // Touched and left again, and gone along: one part.
    EXPECT_EQ(split_path(Places{at(1, 179), at(2, -180), at(3, 179)}).size(), 1u);
    EXPECT_EQ(split_path(Places{at(1, 179), at(2, -180), at(3, 180), at(3, 178)}).size(), 1u);
}

TEST(Antimeridian, PolygonsKeepTheirArea) {
    const Places fiji{at(-19, 177), at(-19, -178), at(-15, -178), at(-15, 177)};
    const auto parts = split_polygon(fiji);
    ASSERT_EQ(parts.size(), 2u);
    expect_writable(parts);
    EXPECT_NEAR(area_of(parts), geodesic_area(fiji).area_m2, 1);
    // A comb with three teeth across it.
    const Places comb{at(0, 178),  at(0, -178), at(1, -178), at(1, 179),  at(2, 179),  at(2, -178),
                      at(3, -178), at(3, 179),  at(4, 179),  at(4, -178), at(5, -178), at(5, 178)};
    const auto pieces = split_polygon(comb);
    EXPECT_EQ(pieces.size(), 4u);
    expect_writable(pieces);
    EXPECT_NEAR(area_of(pieces), geodesic_area(comb).area_m2, 1);
    Places backwards(comb.rbegin(), comb.rend());
    EXPECT_NEAR(area_of(split_polygon(backwards)), geodesic_area(comb).area_m2, 1);
    for (const Places& piece : split_polygon(backwards)) EXPECT_TRUE(geodesic_area(piece).counter_clockwise);
}

TEST(Antimeridian, StarsOfAllSizesKeepTheirArea) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(0, 1);
    for (int i = 0; i < 200; ++i) {
        const LatLon middle = at(-70 + 140 * any(random), 170 + 20 * any(random));
        Places star;
        for (int k = 0; k < 12; ++k)
            star.push_back(
                geodesic_destination(middle, Degrees{-30.0 * k}, 1000 + 1.5e6 * any(random) * any(random)));
        const auto parts = split_polygon(star);
        expect_writable(parts);
        const double area = geodesic_area(star).area_m2;
        EXPECT_NEAR(area_of(parts), area, 1e-9 * area + 1) << i;
    }
}

TEST(Antimeridian, APolygonAroundAPoleGoesThere) {
    for (const double pole : {90.0, -90.0}) {
        const double lat = pole * 80 / 90;
        Places cap{at(lat, 10), at(lat, 130), at(lat, -110)};
        for (int turned = 0; turned < 2; ++turned) {
            const auto parts = split_polygon(cap);
            ASSERT_EQ(parts.size(), 1u);
            expect_writable(parts);
            EXPECT_EQ(parts[0].size(), 7u);  // and twice the antimeridian, and twice the pole
            int at_pole = 0;
            for (const LatLon& place : parts[0]) at_pole += place.lat.value == pole ? 1 : 0;
            EXPECT_EQ(at_pole, 2);
            std::reverse(cap.begin(), cap.end());
        }
    }
}

}  // namespace
}  // namespace relevo::geo
