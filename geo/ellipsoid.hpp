#pragma once

namespace relevo::geo::wgs84 {

// WGS 84 (NIMA TR8350.2): the semi-major axis in metres and the flattening define it, the rest follows.
inline constexpr double kSemiMajor = 6378137.0;
inline constexpr double kFlattening = 1 / 298.257223563;
inline constexpr double kSemiMinor = kSemiMajor * (1 - kFlattening);
inline constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);

}  // namespace relevo::geo::wgs84
