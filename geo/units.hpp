#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace relevo::geo {

// Exact by definition: the international foot and mile (1959), the international nautical mile (1929), and
// the acre of 43560 square feet.
inline constexpr double kMetresPerFoot = 0.3048;
inline constexpr double kMetresPerMile = 5280 * kMetresPerFoot;
inline constexpr double kMetresPerNauticalMile = 1852;
inline constexpr double kSquareMetresPerHectare = 1e4;
inline constexpr double kSquareMetresPerAcre = 43560 * kMetresPerFoot * kMetresPerFoot;
inline constexpr double kSquareMetresPerSquareMile = kMetresPerMile * kMetresPerMile;

/// Which units numbers are shown in; everything is computed in metres.
enum class UnitSystem {
    metric,    ///< m, km; m2, ha, km2; m3
    imperial,  ///< ft, mi; ft2, acres, mi2; yd3
    nautical,  ///< m and nautical miles; all else metric
};

/// "metric", "imperial", "nautical".
std::optional<UnitSystem> unit_system(std::string_view name);

/// "812.345 m", "23.456789 km": always to the millimetre (imperial: 0.001 ft, 0.000001 mi).
std::string length_text(double metres, UnitSystem units);
/// "4372.12 m", "14344.23 ft", with so many decimals.
std::string height_text(double metres, UnitSystem units, int decimals = 3);
/// "512.34 m2", "12.345678 ha", "345.678901 km2"; "1234.5 ft2", "12.345678 acres", "1.234567 mi2".
std::string area_text(double square_metres, UnitSystem units);
/// "1234567.891 m3", "1614753.8 yd3".
std::string volume_text(double cubic_metres, UnitSystem units);

}  // namespace relevo::geo
