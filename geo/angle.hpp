#pragma once

#include <compare>
#include <numbers>

namespace relevo::geo {

/// An angle in degrees: the unit of every public boundary.
struct Degrees {
    double value = 0;

    constexpr Degrees() = default;
    constexpr explicit Degrees(double degrees) : value(degrees) {}

    constexpr double radians() const { return value * (std::numbers::pi / 180); }
    static constexpr Degrees from_radians(double radians) {
        return Degrees{radians * (180 / std::numbers::pi)};
    }

    friend constexpr auto operator<=>(Degrees, Degrees) = default;
    friend constexpr Degrees operator+(Degrees a, Degrees b) { return Degrees{a.value + b.value}; }
    friend constexpr Degrees operator-(Degrees a, Degrees b) { return Degrees{a.value - b.value}; }
    friend constexpr Degrees operator-(Degrees a) { return Degrees{-a.value}; }
};

/// The same direction in [-180, 180).
/// \pre the angle is finite
Degrees wrapped_180(Degrees angle);

/// The same direction in [0, 360).
/// \pre the angle is finite
Degrees wrapped_360(Degrees angle);

}  // namespace relevo::geo
