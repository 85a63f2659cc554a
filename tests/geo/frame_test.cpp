#include "geo/frame.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "geo/geodesic.hpp"

namespace relevo::geo {
namespace {

constexpr double kArcSecond = 1.0 / 3600;

GridFrame frame(double west, double north, double step, int columns, int rows) {
    return {FrameKind::geographic, west, north, step, step, columns, rows};
}

TEST(GridFrame, PostsRoundTripTo1e9OfAPost) {
    const std::array frames{frame(-106, 38, kArcSecond, 3601, 3601),
                            frame(179, -16, 3 * kArcSecond, 2401, 1201), frame(-180, 90, 0.25, 1441, 721),
                            frame(-0.5, 0.5, kArcSecond, 3601, 3601), frame(-180, 10, 0.1, 3600, 200)};
    for (const GridFrame& f : frames) {
        for (int i = 0; i <= 20; ++i) {
            const GridPosition place{(f.columns - 1) * i / 20.0, (f.rows - 1) * (20 - i) / 20.0};
            for (const double turn : {0.0, -360.0, 360.0}) {
                if (f.columns * f.step_x > 359 && turn != 0) continue;  // the closing column is a place too
                LatLon there = f.lat_lon(place);
                there.lon = there.lon + Degrees{turn};
                const GridPosition back = f.grid_position(there);
                EXPECT_NEAR(back.column, place.column, 1e-9);
                EXPECT_NEAR(back.row, place.row, 1e-9);
            }
        }
    }
}

TEST(GridFrame, IsContinuousAcrossTheAntimeridian) {
    const GridFrame f = frame(179, -16, 0.01, 201, 101);
    EXPECT_NEAR(f.lat_lon({150, 0}).lon.value, 180.5, 1e-12);
    const auto column = [&](double lon) { return f.grid_position({Degrees{-16.5}, Degrees{lon}}).column; };
    EXPECT_NEAR(column(180), 100, 1e-9);
    EXPECT_NEAR(column(-180), 100, 1e-9);
    EXPECT_NEAR(column(-179.5), 150, 1e-9);
    EXPECT_NEAR(column(180.5), 150, 1e-9);
    EXPECT_NEAR(column(std::nextafter(180, 0)) - column(std::nextafter(-180, 0)), 0, 1e-9);
    EXPECT_NEAR(column(178.5), -50, 1e-9);   // west of the data
    EXPECT_NEAR(column(-178.5), 250, 1e-9);  // east of it
}

TEST(GridFrame, WholeEarthHasBothItsEdges) {
    const GridFrame f = frame(-180, 90, 0.5, 721, 361);
    EXPECT_EQ(f.grid_position({Degrees{0}, Degrees{-180}}).column, 0);
    EXPECT_EQ(f.grid_position({Degrees{0}, Degrees{180}}).column, 720);
}

TEST(GridFrame, ContainsItsOutermostPostsAndNothingBeyondThem) {
    const GridFrame f = frame(0, 10, 0.5, 5, 3);
    EXPECT_TRUE(f.contains({0, 0}));
    EXPECT_TRUE(f.contains({4, 2}));
    EXPECT_FALSE(f.contains({4.001, 1}));
    EXPECT_FALSE(f.contains({1, 2.001}));
    EXPECT_FALSE(f.contains({-1e-9, 1}));
    EXPECT_FALSE(f.contains({1, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(GridFrame, ClosesWhereItsLastColumnIsItsFirstToHalfAStep) {
    EXPECT_TRUE(frame(-180, 90, 0.5, 721, 361).closes());
    EXPECT_TRUE(frame(0, 10, 0.7, 515, 20).closes());  // 359.8 degrees
    EXPECT_TRUE(frame(0, 10, 0.7, 516, 20).closes() == false);
    EXPECT_FALSE(frame(-180, 90, 0.5, 720, 361).closes());  // a whole step is missing
    EXPECT_FALSE(frame(-180, 90, 0.5, 722, 361).closes());
    EXPECT_FALSE(frame(-180, 90, 1, 1, 1).closes());
    // What is between the ends is at one of them.
    const GridFrame f = frame(0, 10, 0.7, 515, 20);
    EXPECT_EQ(f.grid_position({Degrees{0}, Degrees{359.85}}).column, 514);
    EXPECT_EQ(f.grid_position({Degrees{0}, Degrees{359.95}}).column, 0);
    EXPECT_EQ(f.grid_position({Degrees{0}, Degrees{-0.05}}).column, 0);
    EXPECT_NEAR(f.grid_position({Degrees{0}, Degrees{359.7}}).column, 513.857, 1e-3);
}

TEST(GridFrame, PolesAreLatitudesInSpiteOfRounding) {
    const GridFrame f = frame(-180, 90, 1.0 / 3, 1081, 541);
    EXPECT_EQ(f.lat_lon({0, 0}).lat.value, 90);
    EXPECT_GE(f.lat_lon({0, 540}).lat.value, -90);
    EXPECT_EQ(f.lat_lon({0, 600}).lat.value, -90);  // padding
    const Ecef a = f.ecef({0, 0}, EllipsoidalHeight{100});
    const Ecef b = f.ecef({333, 0}, EllipsoidalHeight{100});
    EXPECT_EQ(a.m, b.m);
}

TEST(GridFrame, SpacingAgreesWithGeodesics) {
    // A degree along a meridian, and along a parallel: the geodesic over a step of 1" differs from the
    // parallel by 1e-9.
    const GridFrame f = frame(10, 80, kArcSecond, 100, 575000);
    for (const double row : {0.0, 36000.0, 287998.0, 500000.0}) {
        const auto spacing = f.spacing({0, row});
        const double north = geodesic(f.lat_lon({0, row - 0.5}), f.lat_lon({0, row + 0.5})).length_m;
        const double east = geodesic(f.lat_lon({0, row}), f.lat_lon({1, row})).length_m;
        EXPECT_NEAR(spacing.row_m / north, 1, 1e-8);
        EXPECT_NEAR(spacing.column_m / east, 1, 1e-8);
    }
    EXPECT_NEAR(frame(0, 90, 1, 3, 3).spacing({0, 0}).column_m, 0, 1e-10);
}

TEST(GridFrame, PadsToTheNextPowerOfTwoPlusOne) {
    EXPECT_EQ(frame(0, 0, 1, 1, 1).padded_side(), 3);
    EXPECT_EQ(frame(0, 0, 1, 3, 3).padded_side(), 3);
    EXPECT_EQ(frame(0, 0, 1, 4, 3).padded_side(), 5);
    EXPECT_EQ(frame(0, 0, 1, 2, 1025).padded_side(), 1025);
    EXPECT_EQ(frame(0, 0, 1, 1026, 2).padded_side(), 2049);
    EXPECT_EQ(frame(0, 0, 1, 3601, 3601).levels(), 12);
}

}  // namespace
}  // namespace relevo::geo
