#include "lod/ocean/sea_chart.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "geo/geodesic.hpp"
#include "lod/ocean/sea_view.hpp"

namespace relevo::lod {
namespace {

geo::LatLon at(double lat, double lon) {
    return {geo::Degrees{lat}, geo::Degrees{lon}};
}

TEST(SeaChart, PlacesComeBack) {
    for (const geo::LatLon anchor : {at(43.5, 7.5), at(0, 0), at(-89.99, 30), at(90, 0), at(12, 179.9)}) {
        const SeaChart chart(anchor);
        for (const glm::dvec2 place :
             {glm::dvec2(0, 0), glm::dvec2(1, -2), glm::dvec2(-4e5, 3e5), glm::dvec2(2e6, 8e6)}) {
            const glm::dvec2 back = chart.at(chart.place(place));
            EXPECT_LT(glm::distance(back, place), 1e-3 + 1e-12 * glm::length(place)) << anchor.lat.value;
        }
    }
}

TEST(SeaChart, LengthsAreGeodesicToHalfAPercentAroundItsAnchor) {
    const geo::LatLon anchor = at(43.5, 7.5);
    const SeaChart chart(anchor);
    for (const glm::dvec2 from : {glm::dvec2(0, 0), glm::dvec2(3e5, -4e5)}) {
        for (const glm::dvec2 way : {glm::dvec2(100, 0), glm::dvec2(0, 100), glm::dvec2(-3e4, 4e4)}) {
            const double length = geo::geodesic(chart.place(from), chart.place(from + way)).length_m;
            EXPECT_NEAR(length / glm::length(way), 1, 0.005);
        }
    }
}

TEST(SeaChartAnchor, StaysOverASceneAndIsNearEverywhere) {
    const geo::LatLon middle = at(43.5, 7.5);
    EXPECT_EQ(sea_chart_anchor(middle, at(44, 7)).lat, middle.lat);
    EXPECT_EQ(sea_chart_anchor(middle, at(43, 8)).lon, middle.lon);
    EXPECT_EQ(sea_chart_anchor(middle, at(43, 8 - 360)).lon, middle.lon);
    for (double lat = -90; lat <= 90; lat += 7.5) {
        for (double lon = -540; lon <= 540; lon += 11) {
            const double away =
                geo::geodesic(sea_chart_anchor(middle, at(lat, lon)), at(lat, std::remainder(lon, 360)))
                    .length_m;
            EXPECT_LT(away, 900e3) << lat << ", " << lon;
        }
    }
}

TEST(Horizon, IsThatOfTheSphere) {
    constexpr double kR = 6371e3;
    EXPECT_NEAR(horizon_m(kR, 2, 0), std::sqrt(2 * kR * 2), 1);
    EXPECT_NEAR(horizon_m(kR, 2, 0), 5048, 1);
    EXPECT_NEAR(horizon_m(kR, 10e6, 0), kR * std::acos(kR / (kR + 10e6)), 1e-3);
    // A crest is seen beyond it, a sunken eye sees as far as one that is as high.
    EXPECT_GT(horizon_m(kR, 2, 1), horizon_m(kR, 2, 0) + 3500);
    EXPECT_EQ(horizon_m(kR, -2, 1), horizon_m(kR, 2, 1));
}

TEST(SeaView, TheSeaDropsByWhatGeodesySays) {
    Camera camera{};
    camera.eye = {geo::Degrees{43.5}, geo::Degrees{7.5}, geo::EllipsoidalHeight{60}};
    const View view(camera);
    const SeaChart chart(at(43.5, 7.5));
    const SeaView sea(view, chart, 50, 0);
    EXPECT_DOUBLE_EQ(sea.eye_m, 10);
    const glm::dvec3 there = sea.offset({10e3, 0}, 0);
    EXPECT_NEAR(glm::dot(there, sea.up), -10 - 7.85, 0.03);
    // Against the ellipsoid: what is left out is the difference of its curvatures.
    const geo::LatLon place = chart.place({10e3, 0});
    const glm::dvec3 exact = geo::to_ecef({place.lat, place.lon, geo::EllipsoidalHeight{50}}) - view.eye();
    EXPECT_LT(std::abs(glm::dot(exact - there, sea.up)), 0.03);
}

}  // namespace
}  // namespace relevo::lod
