#pragma once

namespace relevo::peers {

/// The flat world that other engines draw: metres, x east, y north, z up, the terrain's middle at (0, 0).
struct Place {
    double x, y, z;
};

inline constexpr double kSideM = 31854;
inline constexpr double kEyeM = 7500;  ///< twice the highest post
inline constexpr double kPitchDegrees = -20;
inline constexpr double kFovDegrees = 60;  ///< vertical
inline constexpr double kNearM = 10;
inline constexpr double kFarM = kSideM;  ///< the whole terrain at every frame
/// Where depth is read back: all ground is beyond, and 24 bits tell a metre at the far plane.
inline constexpr double kNearForErrorsM = 1000;

/// The eye at a part, 0 to 1, of the straight way from the south to the north.
inline Place eye_at(double part) {
    return {0, kSideM * (-0.45 + 0.6 * part), kEyeM};
}

inline double radians(double degrees) {
    return degrees * 3.14159265358979323846 / 180;  // for engines whose headers are not C++20
}

/// Direction of the light's source: north-west, 45 degrees high.
inline constexpr Place kToSun{-0.5, 0.5, 0.70710678118654752};

}  // namespace relevo::peers
