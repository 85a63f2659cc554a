#pragma once

#include <compare>

namespace relevo::geo {

/// h: height above the WGS 84 ellipsoid, metres.
struct EllipsoidalHeight {
    double m = 0;
    friend constexpr auto operator<=>(EllipsoidalHeight, EllipsoidalHeight) = default;
};

/// H: height above the vertical datum of the data (by default mean sea level), metres.
struct OrthometricHeight {
    double m = 0;
    friend constexpr auto operator<=>(OrthometricHeight, OrthometricHeight) = default;
};

/// N: height of the geoid above the ellipsoid, metres. h = H + N.
struct Undulation {
    double m = 0;
    friend constexpr auto operator<=>(Undulation, Undulation) = default;
};

constexpr EllipsoidalHeight operator+(OrthometricHeight H, Undulation N) {
    return {H.m + N.m};
}
constexpr OrthometricHeight operator-(EllipsoidalHeight h, Undulation N) {
    return {h.m - N.m};
}

}  // namespace relevo::geo
