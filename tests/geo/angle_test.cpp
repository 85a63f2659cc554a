#include "geo/angle.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace relevo::geo {
namespace {

TEST(Angle, WrapsIntoHalfOpenRanges) {
    EXPECT_EQ(wrapped_180(Degrees{180}).value, -180);
    EXPECT_EQ(wrapped_180(Degrees{-180}).value, -180);
    EXPECT_EQ(wrapped_180(Degrees{540}).value, -180);
    EXPECT_EQ(wrapped_180(Degrees{190}).value, -170);
    EXPECT_EQ(wrapped_180(Degrees{-190}).value, 170);
    EXPECT_EQ(wrapped_360(Degrees{360}).value, 0);
    EXPECT_EQ(wrapped_360(Degrees{-90}).value, 270);
    EXPECT_EQ(wrapped_360(Degrees{725}).value, 5);
}

TEST(Angle, TinyNegativeAngleIsNotAWholeTurn) {
    EXPECT_EQ(wrapped_360(Degrees{-std::numeric_limits<double>::min()}).value, 0);
    EXPECT_EQ(wrapped_360(Degrees{-1e-20}).value, 0);
    EXPECT_FALSE(std::signbit(wrapped_360(Degrees{-0.0}).value));
}

TEST(Angle, WholeTurnsCostNoDigit) {
    const double angle = std::nextafter(33.3, 40);
    for (const int turns : {-1000, -1, 1, 7}) {
        // Only what the sum itself rounds may be lost.
        const double turned = angle + 360.0 * turns;
        EXPECT_EQ(wrapped_180(Degrees{turned}).value, turned - 360.0 * turns);
    }
}

}  // namespace
}  // namespace relevo::geo
