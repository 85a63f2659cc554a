// Grids around the poles: UPS, as GeographicLib and as a closed form in long double have it.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <GeographicLib/UTMUPS.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "geo/frame.hpp"
#include "geo/geodesic.hpp"
#include "geo/post_positions.hpp"
#include "tests/geo/position_difference.hpp"

namespace relevo::geo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

GridFrame polar(FrameKind kind, double west, double north, double step, int columns, int rows) {
    return {kind, west, north, step, step, columns, rows};
}

/// Frames with the pole inside, on a post, on the border, in a corner, outside; and one to beyond the
/// equator.
std::vector<GridFrame> frames() {
    std::vector<GridFrame> all;
    for (const FrameKind kind : {FrameKind::ups_north, FrameKind::ups_south}) {
        all.push_back(polar(kind, 2e6 - 1000.3, 2e6 + 999.1, 10, 201, 201));
        all.push_back(polar(kind, 2e6 - 1000, 2e6 + 1000, 10, 201, 201));
        all.push_back(polar(kind, 2e6, 2e6 + 1000, 10, 201, 201));
        all.push_back(polar(kind, 2e6, 2e6, 10, 201, 201));
        all.push_back(polar(kind, 2.3e6, 1.2e6, 90, 2001, 1025));
        all.push_back(polar(kind, -1.3e6, 5.3e6, 1000, 6601, 6601));
        all.push_back(polar(kind, -14e6, 16e6, 20e3, 1601, 1601));
        all.push_back({kind, 1.9e6, 2.4e6, 31.25, 500, 4097, 3});
    }
    return all;
}

/// Distance between places given in degrees, metres, for places next to each other.
double apart(LatLon a, LatLon b) {
    return glm::length(to_ecef({a.lat, a.lon, {}}).m - to_ecef({b.lat, b.lon, {}}).m);
}

TEST(PolarFrame, IsUps) {
    for (const bool north : {true, false}) {
        const GridFrame f = polar(north ? FrameKind::ups_north : FrameKind::ups_south, 0, 4e6, 1, 2, 2);
        for (double lat = 84; lat <= 90; lat += 0.25) {
            for (double lon = -180; lon <= 180; lon += 15) {
                int zone = 0;
                bool northp = false;
                double easting = 0;
                double northing = 0;
                const LatLon place{Degrees{north ? lat : -lat}, Degrees{lon}};
                GeographicLib::UTMUPS::Forward(place.lat.value, lon, zone, northp, easting, northing,
                                               GeographicLib::UTMUPS::UPS);
                const GridPosition at = f.grid_position(place);
                EXPECT_NEAR(at.column, easting, 1e-9);
                EXPECT_NEAR(4e6 - at.row, northing, 1e-9);
                EXPECT_LT(apart(f.lat_lon({easting, 4e6 - northing}), place), 4e-9) << lat << " " << lon;
            }
        }
    }
}

TEST(PolarFrame, AgreesWithTheClosedForm) {
    // Snyder (1987), Map projections: a working manual, 15-9, 21-33 and 21-30, in long double.
    const long double f = 1 / 298.257223563L;
    const long double e = std::sqrt(f * (2 - f));
    const long double pi = std::acos(-1.0L);
    for (const bool north : {true, false}) {
        const GridFrame grid = polar(north ? FrameKind::ups_north : FrameKind::ups_south, 0, 4e6, 1, 2, 2);
        for (const double lat : {20.0, 60.0, 75.0, 80.1, 84.0, 88.0, 89.5, 89.9999, 90.0}) {
            for (const double lon : {-180.0, -135.0, -90.0, -1e-9, 0.0, 33.3, 90.0, 179.9999}) {
                const long double phi = lat * pi / 180;
                const long double s = e * std::sin(phi);
                const long double t = std::tan((90 - static_cast<long double>(lat)) / 360 * pi) /
                                      std::pow((1 - s) / (1 + s), e / 2);
                const long double rho =
                    2 * 6378137.0L * 0.994L * t / std::sqrt(std::pow(1 + e, 1 + e) * std::pow(1 - e, 1 - e));
                const long double easting = 2e6L + rho * std::sin(lon * pi / 180);
                const long double northing = 2e6L + (north ? -1 : 1) * rho * std::cos(lon * pi / 180);
                const GridPosition at = grid.grid_position({Degrees{north ? lat : -lat}, Degrees{lon}});
                EXPECT_NEAR(at.column, static_cast<double>(easting), 4e-9) << lat << " " << lon;
                EXPECT_NEAR(4e6 - at.row, static_cast<double>(northing), 4e-9) << lat << " " << lon;
            }
        }
    }
}

TEST(PolarFrame, PostsRoundTrip) {
    for (const GridFrame& f : frames()) {
        for (int i = 0; i <= 20; ++i) {
            for (int k = 0; k <= 20; ++k) {
                const GridPosition place{(f.columns - 1) * i / 20.0, (f.rows - 1) * k / 20.0};
                const LatLon there = f.lat_lon(place);
                ASSERT_TRUE(std::abs(there.lat.value) <= 90 && std::abs(there.lon.value) <= 180);
                // As far from the pole as the equator a nanometre on the ground is two in the plane.
                const double far = 1e-15 * std::hypot(f.west + place.column * f.step_x - 2e6,
                                                      f.north - place.row * f.step_y - 2e6);
                for (const double turn : {0.0, -360.0, 360.0}) {
                    const GridPosition back = f.grid_position({there.lat, there.lon + Degrees{turn}});
                    EXPECT_NEAR(back.column * f.step_x, place.column * f.step_x, 3e-9 + far);
                    EXPECT_NEAR(back.row * f.step_y, place.row * f.step_y, 3e-9 + far);
                }
            }
        }
    }
}

TEST(PolarFrame, ThePoleItselfIsAPlaceLikeAnyOther) {
    for (const FrameKind kind : {FrameKind::ups_north, FrameKind::ups_south}) {
        const double pole = kind == FrameKind::ups_north ? 90 : -90;
        const GridFrame f = polar(kind, 2e6 - 1000, 2e6 + 1000, 10, 201, 201);
        EXPECT_EQ(f.lat_lon({100, 100}).lat.value, pole);
        EXPECT_EQ(f.lat_lon({100, 100}).lon.value, 0);
        for (const double lon : {-180.0, -90.0, 0.0, 17.0, 180.0, 540.0}) {
            const GridPosition at = f.grid_position({Degrees{pole}, Degrees{lon}});
            EXPECT_EQ(at.column, 100);
            EXPECT_EQ(at.row, 100);
            const GridPosition far = f.grid_position({Degrees{-pole}, Degrees{lon}});
            EXPECT_TRUE(std::isfinite(far.column) && std::isfinite(far.row));
            EXPECT_GT(std::hypot(far.column, far.row), 1e9) << "the other pole";
        }
    }
}

TEST(PolarFrame, SpacingAgreesWithGeodesics) {
    for (const GridFrame& f : frames()) {
        for (const GridPosition at : {GridPosition{10, 1}, GridPosition{100.25, 2}, GridPosition{177, 1}}) {
            const auto spacing = f.spacing(at);
            const double d = 1 / std::max(f.step_x, f.step_y);  // about a metre each way
            const auto column =
                geodesic(f.lat_lon({at.column - d, at.row}), f.lat_lon({at.column + d, at.row}));
            const auto row = geodesic(f.lat_lon({at.column, at.row - d}), f.lat_lon({at.column, at.row + d}));
            EXPECT_NEAR(column.length_m / (2 * d * spacing.column_m), 1, 1e-7);
            EXPECT_NEAR(row.length_m / (2 * d * spacing.row_m), 1, 1e-7);
        }
    }
    const GridFrame f = polar(FrameKind::ups_south, 2e6 - 1000, 2e6 + 1000, 10, 201, 201);
    EXPECT_NEAR(f.spacing({100, 100}).column_m, 10 / 0.994, 1e-12);
}

TEST(PolarFrame, UpAzimuthIsTheDirectionOfFallingRows) {
    for (const GridFrame& f : frames()) {
        for (const GridPosition at : {GridPosition{7, 1}, GridPosition{133.5, 0.75}}) {
            const double d = 1 / f.step_y;
            const LatLon here = f.lat_lon(at);
            const double azimuth = geodesic(here, f.lat_lon({at.column, at.row - d})).azimuth1.value;
            EXPECT_NEAR(std::remainder(f.up_azimuth(here.lon).value - azimuth, 360), 0, 1e-5);
        }
    }
    EXPECT_EQ((GridFrame{}.up_azimuth(Degrees{77}).value), 0);
}

TEST(PolarFrame, ExtentIsThatOfAllPosts) {
    for (const GridFrame& f : frames()) {
        const auto extent = f.extent();
        const int step_x = std::max(1, (f.columns - 1) / 200);
        const int step_y = std::max(1, (f.rows - 1) / 200);
        double south = kInfinity;
        double north = -kInfinity;
        double least_from_west = kInfinity;
        double most_from_west = -kInfinity;
        bool pole = false;
        for (int i = 0; i < f.rows + step_y; i += step_y) {
            for (int k = 0; k < f.columns + step_x; k += step_x) {
                const int row = std::min(i, f.rows - 1);
                const int column = std::min(k, f.columns - 1);
                const LatLon place = f.lat_lon({static_cast<double>(column), static_cast<double>(row)});
                south = std::min(south, place.lat.value);
                north = std::max(north, place.lat.value);
                pole = pole || std::abs(place.lat.value) == 90;
                const double off = wrapped_360(Degrees{place.lon.value - extent.west + 1e-9}).value - 1e-9;
                least_from_west = std::min(least_from_west, off);
                most_from_west = std::max(most_from_west, off);
            }
        }
        EXPECT_LE(extent.south, south + 1e-12);
        EXPECT_GE(extent.north, north - 1e-12);
        EXPECT_GE(extent.west, -180);
        EXPECT_LE(most_from_west, extent.east - extent.west + 1e-9);
        const double tolerance = 1e-7 * std::max(f.step_x * step_x, f.step_y * step_y) * 100;
        EXPECT_NEAR(extent.south, south, tolerance);
        EXPECT_NEAR(extent.north, north, tolerance);
        if (extent.east - extent.west < 360) {
            EXPECT_FALSE(pole);
            EXPECT_NEAR(least_from_west, 0, 1e-9) << "a corner";
            EXPECT_NEAR(most_from_west, extent.east - extent.west, 1e-9);
        }
    }
    const auto all = polar(FrameKind::ups_north, 2e6 - 1000.3, 2e6 + 999.1, 10, 201, 201).extent();
    EXPECT_EQ(all.north, 90);
    EXPECT_EQ(all.west, -180);
    EXPECT_EQ(all.east, 180);
    // Across the antimeridian, which runs up from the north pole's grid.
    const auto across = polar(FrameKind::ups_north, 2e6 - 1000, 2e6 + 5000, 10, 201, 201).extent();
    EXPECT_GT(across.west, 150);
    EXPECT_LT(across.west, 180);
    EXPECT_NEAR(across.west + across.east, 360, 1e-9);
}

TEST(PolarPositions, AgreeWithGeographicLib) {
    double worst = 0;
    for (const GridFrame& frame : frames()) {
        const double here = worst_difference(frame);
        EXPECT_LT(here, 8e-9) << "padded side " << frame.padded_side() << ", step " << frame.step_x;
        worst = std::max(worst, here);
    }
    RecordProperty("worst_nm", std::to_string(worst * 1e9));
}

TEST(PolarPositions, SpacingIsTheFramesOwn) {
    for (const GridFrame& frame : frames()) {
        const PostPositions posts(frame);
        for (const int column : {0, 100, 177}) {
            const auto fast = posts.polar()->spacing(column, 1);
            const auto exact = frame.spacing({static_cast<double>(column), 1});
            EXPECT_NEAR(fast.column_m / exact.column_m, 1, 1e-13);
            EXPECT_NEAR(fast.row_m / exact.row_m, 1, 1e-13);
        }
    }
}

TEST(PolarPositions, ThePoleIsOnTheAxis) {
    const PostPositions north(polar(FrameKind::ups_north, 2e6 - 1000, 2e6 + 1000, 10, 201, 201));
    const PostPositions south(polar(FrameKind::ups_south, 2e6 - 1000, 2e6 + 1000, 10, 201, 201));
    EXPECT_NEAR(glm::length(north.at(100, 100, 7) - glm::dvec3(0, 0, 6356752.314245179 + 7)), 0, 2e-9);
    EXPECT_NEAR(glm::length(south.at(100, 100, 7) + glm::dvec3(0, 0, 6356752.314245179 + 7)), 0, 2e-9);
    EXPECT_NEAR(glm::length(south.normal(100, 100) - glm::dvec3(0, 0, -1)), 0, 1e-15);
}

TEST(PolarPositions, NormalIsTheDirectionOfHeight) {
    for (const GridFrame& frame : frames()) {
        const PostPositions posts(frame);
        for (const int column : {0, 77, 133}) {
            const glm::dvec3 step = posts.at(column, 2, 1000) - posts.at(column, 2, 0);
            EXPECT_LT(glm::length(step / 1000.0 - posts.normal(column, 2)), 1e-11);
            EXPECT_NEAR(glm::length(posts.normal(column, 2)), 1, 1e-15);
        }
    }
}

}  // namespace
}  // namespace relevo::geo
