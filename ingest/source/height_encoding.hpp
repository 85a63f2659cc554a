#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace relevo::ingest {

/// How web tiles pack a height into red, green and blue. Such colours must be decoded before anything is
/// interpolated: next to a carry from green to red a mean of colours is a mountain.
enum class HeightEncoding {
    terrain_rgb,  ///< Mapbox: (65536 R + 256 G + B) / 10 - 10000 metres
    terrarium,    ///< Mapzen: 256 R + G + B / 256 - 32768 metres
};

/// Metres; NaN for black, which both use for "nothing here" (-10 000 m and -32 768 m).
inline double decoded_height(HeightEncoding encoding, std::uint8_t red, std::uint8_t green,
                             std::uint8_t blue) {
    if (red == 0 && green == 0 && blue == 0) return std::numeric_limits<double>::quiet_NaN();
    const int whole = red * 65536 + green * 256 + blue;
    return encoding == HeightEncoding::terrain_rgb ? (whole - 100000) / 10.0 : whole / 256.0 - 32768;
}

/// "terrain-rgb", "terrarium".
inline std::optional<HeightEncoding> height_encoding_from(const std::string& text) {
    if (text == "terrain-rgb") return HeightEncoding::terrain_rgb;
    if (text == "terrarium") return HeightEncoding::terrarium;
    return {};
}

}  // namespace relevo::ingest
