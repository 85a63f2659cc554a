#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "geo/ellipsoid.hpp"
#include "lod/measure/area.hpp"
#include "lod/measure/cell_sums.hpp"
#include "tests/geo/outside_program.hpp"
#include "tests/lod/measured_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

using test::grid;
using test::lat_lon;
using test::MeasuredScene;
using test::rough;
using Places = std::vector<geo::LatLon>;

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

AreaMeasurement measure(const MeasuredScene& scene, const Places& polygon, std::optional<double> plane = {}) {
    const auto area = measure_area(scene.scene(), polygon, {plane, {}});
    EXPECT_TRUE(area) << area.error().message;
    return area ? *area : AreaMeasurement{};
}

/// A box of posts, its sides along parallels so often broken that they are these to a nanometre or so.
Places box(const geo::GridFrame& frame, double west, double north, double east, double south) {
    Places places;
    constexpr int kParts = 400;
    for (int i = 0; i <= kParts; ++i)
        places.push_back(frame.lat_lon({west + (east - west) * i / kParts, north}));
    for (int i = 0; i <= kParts; ++i)
        places.push_back(frame.lat_lon({east + (west - east) * i / kParts, south}));
    return places;
}

/// The same by brute force over a box: so many triangles a cell in space, and columns under them.
struct Brute {
    double area = 0;
    double surface = 0;
    double above = 0;
    double below = 0;
    double H = 0;
};

Brute brute(const MeasuredScene& scene, double west, double north, double east, double south, double plane,
            int parts) {
    Brute sum;
    const geo::GridFrame& frame = scene.frame();
    const int across = static_cast<int>(std::lround((east - west) * parts));
    const int down = static_cast<int>(std::lround((south - north) * parts));
    const double step_c = (east - west) / across;
    const double step_r = (south - north) / down;
    const auto at = [&](double column, double row, bool ground) {
        const auto place = frame.lat_lon({column, row});
        const double H = ground ? static_cast<double>(scene.brute_height(place)) : 0;
        return frame.ecef({column, row}, geo::EllipsoidalHeight{H}).m;
    };
    const auto triangle = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return 0.5 * glm::length(glm::cross(b - a, c - a));
    };
    for (int j = 0; j < down; ++j) {
        for (int i = 0; i < across; ++i) {
            const double c = west + i * step_c;
            const double r = north + j * step_r;
            const auto quad = [&](bool ground) {
                const auto nw = at(c, r, ground);
                const auto ne = at(c + step_c, r, ground);
                const auto sw = at(c, r + step_r, ground);
                const auto se = at(c + step_c, r + step_r, ground);
                return triangle(nw, ne, se) + triangle(nw, se, sw);
            };
            const double base = quad(false);
            const double surface = quad(true);
            const auto middle = frame.lat_lon({c + 0.5 * step_c, r + 0.5 * step_r});
            const double H = static_cast<double>(scene.brute_height(middle));
            sum.area += base;
            sum.surface += surface;
            sum.H += H * base;
            sum.above += std::max(H - plane, 0.0) * base;
            sum.below += std::max(plane - H, 0.0) * base;
        }
    }
    return sum;
}

TEST(MeasureArea, OfALevelSurfaceIsClosedForm) {
    for (const double level : {0.0, 3000.0}) {
        MeasuredScene scene(grid(10, 47, 0.002, 300, 300), [&](int, int) { return level; });
        const Places polygon{lat_lon(46.45, 10.05), lat_lon(46.5, 10.55), lat_lon(46.9, 10.31)};
        const auto area = measure(scene, polygon, 1000.0);
        const double base = area.geodesic.area_m2;
        // Sides are followed to 1e-6 posts.
        const double sides = area.geodesic.perimeter_m * 1e-6 * 223;
        EXPECT_NEAR(area.measured_m2, base, sides);
        EXPECT_EQ(area.outside_m2, 0);
        EXPECT_EQ(area.void_m2, 0);
        EXPECT_EQ(area.lowest->value, level);
        EXPECT_NEAR(*area.mean_H_m, level, 1e-8);
        EXPECT_NEAR(*area.mean_slope_deg, 0, 1e-12);
        EXPECT_NEAR(*area.volume_above_m3, std::max(level - 1000, 0.0) * base, sides * 2000);
        EXPECT_NEAR(*area.volume_below_m3, std::max(1000 - level, 0.0) * base, sides * 2000);
        // At its height the ellipsoid is (1 + h/N)(1 + h/M) as large.
        const double s = std::sin(geo::Degrees{46.62}.radians());
        const double w2 = 1 - geo::wgs84::kEccentricity2 * s * s;
        const double across = geo::wgs84::kSemiMajor / std::sqrt(w2);
        const double along = across * (1 - geo::wgs84::kEccentricity2) / w2;
        EXPECT_NEAR(*area.surface_m2 / base, (1 + level / across) * (1 + level / along), 2e-8);
    }
}

TEST(MeasureArea, EqualsBruteForceOverABox) {
    const auto smooth = [](int column, int row) {
        return 500 + 300 * std::sin(column * 0.4) * std::cos(row * 0.3) + 20 * column;
    };
    for (const bool steep : {false, true}) {
        MeasuredScene scene(grid(10, 47, 0.001, 30, 30), [&](int column, int row) {
            return steep ? rough(column, row) : smooth(column, row);
        });
        const double plane = 520;
        const auto area = measure(scene, box(scene.frame(), 3, 4, 19, 15), plane);
        // Of ever finer parts the error falls with the square of their size: two give what they tend to.
        const auto coarse = brute(scene, 3, 4, 19, 15, plane, 20);
        const auto fine = brute(scene, 3, 4, 19, 15, plane, 40);
        const auto limit = [&](double Brute::*sum) { return fine.*sum + (fine.*sum - coarse.*sum) / 3; };
        EXPECT_NEAR(area.measured_m2 / limit(&Brute::area), 1, 1e-8);
        EXPECT_NEAR(*area.surface_m2 / limit(&Brute::surface), 1, 1e-6);
        EXPECT_NEAR(*area.mean_H_m, limit(&Brute::H) / limit(&Brute::area), 1e-5);
        EXPECT_NEAR(*area.volume_above_m3 / limit(&Brute::above), 1, 1e-5);
        EXPECT_NEAR(*area.volume_below_m3 / limit(&Brute::below), 1, 1e-5);
    }
}

TEST(MeasureArea, OfATiltedPlaneIsClosedForm) {
    // On the equator, so small that a degree is the same length all over.
    const double step = 0.0002;
    const double east_m = geo::wgs84::kSemiMajor * geo::Degrees{step}.radians();
    const double north_m = east_m * (1 - geo::wgs84::kEccentricity2);
    MeasuredScene scene(grid(0, 0.004, step, 41, 41),
                        [&](int column, int row) { return 4.0 * column + 3.0 * (40 - row); });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const Places polygon{at(2.3, 38.1), at(36.7, 31.9), at(30.2, 3.4), at(8.8, 9.7)};
    const auto area = measure(scene, polygon);
    const double east = 4 / east_m;
    const double north = 3 / north_m;
    const double slope = std::hypot(east, north);
    EXPECT_NEAR(*area.mean_slope_deg, geo::Degrees::from_radians(std::atan(slope)).value, 1e-5);
    EXPECT_NEAR(area.steepest_deg->value, *area.mean_slope_deg, 1e-5);
    const double h = *area.mean_H_m;
    const double larger = 1 + h / (geo::wgs84::kSemiMajor * (1 - geo::wgs84::kEccentricity2 / 2));
    EXPECT_NEAR(*area.surface_m2 / (area.geodesic.area_m2 * larger * std::hypot(larger, slope)), 1, 2e-7);
    EXPECT_NEAR(area.lowest->value, 4 * 2.3 + 3 * (40 - 38.1), 1e-6);
    EXPECT_NEAR(area.highest->value, 4 * 30.2 + 3 * (40 - 3.4), 1e-6);
    // Mean of a linear function: its value at the centroid (Bourke's formula, in posts).
    const double c[] = {2.3, 36.7, 30.2, 8.8};
    const double r[] = {38.1, 31.9, 3.4, 9.7};
    double twice = 0;
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const int k = (i + 1) % 4;
        const double part = c[i] * r[k] - c[k] * r[i];
        twice += part;
        sum += part * (120 + 4 * (c[i] + c[k]) + 3 * (80 - r[i] - r[k]));
    }
    EXPECT_NEAR(h, sum / (3 * twice), 1e-5);
    EXPECT_NEAR(*area.volume_above_m3, (h - area.lowest->value) * area.geodesic.area_m2, 1e-3 * h);
    EXPECT_EQ(*area.plane_H_m, area.lowest->value);
    EXPECT_EQ(*area.volume_below_m3, 0);
}

TEST(MeasureArea, OfAConeIsClosedForm) {
    const double step = 0.0001;
    const double east_m = geo::wgs84::kSemiMajor * geo::Degrees{step}.radians();
    const double north_m = east_m * (1 - geo::wgs84::kEccentricity2);
    constexpr double kRadius = 1200;
    constexpr double kHeight = 900;
    MeasuredScene scene(grid(0, 0.015, step, 301, 301), [&](int column, int row) {
        return kHeight * (1 - std::hypot((column - 150) * east_m, (row - 150) * north_m) / kRadius);
    });
    Places circle;
    for (int i = 0; i < 720; ++i)
        circle.push_back(geo::geodesic_destination(lat_lon(0, 0.015), geo::Degrees{-0.5 * i}, kRadius));
    const auto area = measure(scene, circle, 0.0);
    const double pi = std::acos(-1);
    EXPECT_NEAR(*area.volume_above_m3 / (pi * kRadius * kRadius * kHeight / 3), 1, 1e-4);
    EXPECT_NEAR(*area.surface_m2 / (pi * kRadius * std::hypot(kRadius, kHeight)), 1, 2e-4);
    EXPECT_NEAR(area.highest->value, kHeight, 1e-3);
    // Above half its height there is a cone of half the size.
    const auto half = measure(scene, circle, kHeight / 2);
    EXPECT_NEAR(*half.volume_above_m3 / (pi * kRadius * kRadius * kHeight / 24), 1, 2e-4);
    EXPECT_NEAR(*half.mean_slope_deg, std::atan(kHeight / kRadius) * 180 / pi, 0.05);
}

// Two parts with a common side are the whole, whatever cells and tiles the side goes through.
TEST(MeasureArea, PartsAddUp) {
    MeasuredScene scene(grid(10, 50, 0.0005, 1100, 1060), [](int column, int row) {
        return column % 97 == 5 && row % 89 == 7 ? kVoid : 0.05 * rough(column, row);
    });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const Places whole{at(20.5, 1050.1), at(1033.3, 1020.7), at(1080, 620),
                       at(1060, 30),     at(500, 333),       at(60, 90)};
    const Places first{whole[0], whole[1], whole[4], whole[5]};
    const Places second{whole[1], whole[2], whole[3], whole[4]};
    const auto all = measure(scene, whole, 20.0);
    const auto a = measure(scene, first, 20.0);
    const auto b = measure(scene, second, 20.0);
    // The common side is within 15 nm of itself in both directions.
    const auto same = [](double sum, double expected) { EXPECT_NEAR(sum / expected, 1, 1e-8); };
    same(a.measured_m2 + b.measured_m2, all.measured_m2);
    same(a.void_m2 + b.void_m2, all.void_m2);
    same(a.geodesic.area_m2 + b.geodesic.area_m2, all.geodesic.area_m2);
    EXPECT_NEAR(all.measured_m2 + all.void_m2, all.geodesic.area_m2, all.geodesic.perimeter_m * 1e-6 * 56);
    EXPECT_NEAR((*a.surface_m2 + *b.surface_m2) / *all.surface_m2, 1, 1e-8);
    same(*a.volume_above_m3 + *b.volume_above_m3, *all.volume_above_m3);
    same(*a.volume_below_m3 + *b.volume_below_m3, *all.volume_below_m3);
    EXPECT_NEAR(std::min(a.lowest->value, b.lowest->value), all.lowest->value, 1e-9);
    EXPECT_NEAR(std::max(a.steepest_deg->value, b.steepest_deg->value), all.steepest_deg->value, 1e-9);
    EXPECT_GT(all.void_m2, 0);
}

TEST(MeasureArea, SaysWhatIsVoidAndOutside) {
    MeasuredScene scene(grid(0, 0.05, 0.01, 11, 11),
                        [](int column, int row) { return column == 5 && row == 5 ? kVoid : 100; });
    const auto at = [&](double column, double row) { return scene.frame().lat_lon({column, row}); };
    const auto area = measure(scene, {at(2, 8), at(8, 8), at(8, 2), at(2, 2)});
    EXPECT_NEAR(area.void_m2 / area.geodesic.area_m2, 4.0 / 36, 1e-6);
    EXPECT_NEAR(area.measured_m2 / area.geodesic.area_m2, 32.0 / 36, 1e-6);
    const auto half = measure(scene, {at(-4, 8), at(4, 8), at(4, 2), at(-4, 2)});
    EXPECT_NEAR(half.outside_m2 / half.geodesic.area_m2, 0.5, 1e-6);
    const auto none = measure(scene, {at(20, 8), at(28, 8), at(28, 2)});
    EXPECT_EQ(none.outside_m2, none.geodesic.area_m2);
    EXPECT_FALSE(none.surface_m2 || none.lowest || none.mean_H_m || none.volume_above_m3);
}

TEST(MeasureArea, IsTheSameAcrossTheAntimeridianAndInAllTurns) {
    const auto make = [](double west) {
        return std::make_unique<MeasuredScene>(grid(west, -16, 0.002, 300, 200), rough);
    };
    const auto polygon = [](double west, double turn) {
        return Places{lat_lon(-16.35, west + 0.05), lat_lon(-16.3, west + 0.55 + turn),
                      lat_lon(-16.05, west + 0.3)};
    };
    const auto a = measure(*make(10), polygon(10, 0));
    const auto there = make(179.7);  // in the same folder
    for (const double turn : {0.0, 360.0, -360.0}) {
        const auto b = measure(*there, polygon(179.7, turn));
        EXPECT_NEAR(a.measured_m2 / b.measured_m2, 1, 1e-9);
        EXPECT_NEAR(*a.surface_m2 / *b.surface_m2, 1, 1e-9);
        EXPECT_NEAR(*a.volume_above_m3 / *b.volume_above_m3, 1, 1e-9);
        EXPECT_EQ(b.outside_m2, 0);
    }
}

TEST(MeasureArea, HoldsPoles) {
    // The cap around a pole in all grids that have one.
    for (const bool north : {true, false}) {
        const double sign = north ? 1 : -1;
        Places cap;
        for (int i = 0; i < 40; ++i) cap.push_back(lat_lon(sign * (86 + i % 3), sign * 9 * i - 170));
        const geo::GridFrame polar =
            test::polar_frame(north ? geo::FrameKind::ups_north : geo::FrameKind::ups_south, 201, 201, 5000);
        const geo::GridFrame round{
            geo::FrameKind::geographic, -180, north ? 90.0 : -80.0, 0.5, 0.25, 721, 41};
        for (const geo::GridFrame& frame : {polar, round}) {
            MeasuredScene scene(frame, [](int, int) { return 1000; });
            const auto area = measure(scene, cap);
            EXPECT_NEAR(area.measured_m2 / area.geodesic.area_m2, 1, frame.is_polar() ? 1e-7 : 1e-6)
                << frame.is_polar();
            EXPECT_NEAR(*area.mean_H_m, 1000, 1e-6);
            EXPECT_NEAR(*area.surface_m2 / area.measured_m2, std::pow(1 + 1000 / 6399e3, 2), 1e-7);
            Places backwards(cap.rbegin(), cap.rend());
            EXPECT_NEAR(measure(scene, backwards).measured_m2 / area.measured_m2, 1, 1e-9);
        }
    }
}

TEST(MeasureArea, RefusesWhatIsNoPolygon) {
    MeasuredScene scene(grid(0, 1, 0.01, 101, 101), rough);
    const auto message = [&](const Places& polygon) {
        const auto area = measure_area(scene.scene(), polygon);
        EXPECT_FALSE(area);
        if (area) return std::string();
        EXPECT_EQ(area.error().kind, ErrorKind::input);
        return area.error().message;
    };
    const auto bow = message({lat_lon(0.2, 0.2), lat_lon(0.4, 0.4), lat_lon(0.2, 0.4), lat_lon(0.4, 0.2)});
    EXPECT_NE(bow.find("cross each other at 0.300"), std::string::npos) << bow;
    EXPECT_NE(message({lat_lon(1, 1), lat_lon(1, 1), lat_lon(1, 1)}).find("no area"), std::string::npos);
    EXPECT_NE(message({lat_lon(-80, -170), lat_lon(-80, 0), lat_lon(-80, 170), lat_lon(80, 170),
                       lat_lon(80, 0), lat_lon(80, -170)})
                  .find("half the earth"),
              std::string::npos);
    // A vertex given twice is none.
    const auto twice = measure_area(
        scene.scene(), Places{lat_lon(0.2, 0.2), lat_lon(0.2, 0.2), lat_lon(0.4, 0.2), lat_lon(0.4, 0.4)});
    EXPECT_TRUE(twice);
}

TEST(MeasureArea, GeodesicFiguresArePlanimeters) {
    MeasuredScene scene(grid(0, 1, 0.01, 11, 11), rough);
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> any(0, 1);
    for (int i = 0; i < 20; ++i) {
        const auto middle = lat_lon(-89 + 178 * any(random), 360 * any(random) - 180);
        Places star;
        std::vector<std::string> input;
        for (int k = 0; k < 9; ++k) {
            star.push_back(
                geo::geodesic_destination(middle, geo::Degrees{-40.0 * k}, 1e5 + 2e6 * any(random)));
            input.push_back(fmt::format("{:.17g} {:.17g}", star.back().lat.value, star.back().lon.value));
        }
        const auto answer = test::ask("Planimeter -p 10", input);
        if (answer.empty()) GTEST_SKIP() << "Planimeter is not installed (package geographiclib-tools)";
        const auto expected = test::numbers(answer[0]);  // number, perimeter, area
        const auto area = measure_area(scene.scene(), star);
        if (!area) continue;  // a star around a pole that this grid cannot have
        EXPECT_NEAR(area->geodesic.perimeter_m, expected[1], 1e-7);
        EXPECT_NEAR(area->geodesic.area_m2, std::abs(expected[2]), 0.1);
    }
}

}  // namespace
}  // namespace relevo::lod
