#include "geo/units.hpp"

#include <cmath>

#include <fmt/format.h>

namespace relevo::geo {

std::optional<UnitSystem> unit_system(std::string_view name) {
    if (name == "metric") return UnitSystem::metric;
    if (name == "imperial") return UnitSystem::imperial;
    if (name == "nautical") return UnitSystem::nautical;
    return {};
}

std::string length_text(double metres, UnitSystem units) {
    const double size = std::abs(metres);
    switch (units) {
        case UnitSystem::imperial:
            return size < kMetresPerMile ? fmt::format("{:.3f} ft", metres / kMetresPerFoot)
                                         : fmt::format("{:.6f} mi", metres / kMetresPerMile);
        case UnitSystem::nautical:
            return size < kMetresPerNauticalMile
                       ? fmt::format("{:.3f} m", metres)
                       : fmt::format("{:.6f} nautical miles", metres / kMetresPerNauticalMile);
        case UnitSystem::metric:
            break;
    }
    return size < 1e4 ? fmt::format("{:.3f} m", metres) : fmt::format("{:.6f} km", metres / 1000);
}

std::string height_text(double metres, UnitSystem units, int decimals) {
    return units == UnitSystem::imperial ? fmt::format("{:.{}f} ft", metres / kMetresPerFoot, decimals)
                                         : fmt::format("{:.{}f} m", metres, decimals);
}

std::string area_text(double square_metres, UnitSystem units) {
    const double size = std::abs(square_metres);
    if (units == UnitSystem::imperial) {
        if (size < kSquareMetresPerAcre)
            return fmt::format("{:.3f} ft2", square_metres / (kMetresPerFoot * kMetresPerFoot));
        if (size < kSquareMetresPerSquareMile)
            return fmt::format("{:.6f} acres", square_metres / kSquareMetresPerAcre);
        return fmt::format("{:.6f} mi2", square_metres / kSquareMetresPerSquareMile);
    }
    if (size < kSquareMetresPerHectare) return fmt::format("{:.3f} m2", square_metres);
    if (size < 1e6) return fmt::format("{:.6f} ha", square_metres / kSquareMetresPerHectare);
    return fmt::format("{:.6f} km2", square_metres / 1e6);
}

std::string volume_text(double cubic_metres, UnitSystem units) {
    constexpr double kCubicMetresPerCubicYard = 27 * kMetresPerFoot * kMetresPerFoot * kMetresPerFoot;
    return units == UnitSystem::imperial ? fmt::format("{:.3f} yd3", cubic_metres / kCubicMetresPerCubicYard)
                                         : fmt::format("{:.3f} m3", cubic_metres);
}

}  // namespace relevo::geo
