#pragma once

#include <bit>
#include <cstdint>

namespace relevo::lod {

// Errors and radii are stored in 16 bits: a float's exponent and the first 8 bits of its mantissa, rounded
// up, so that a decoded value is never below the true one and at most 0.4 % above. Codes sort as their values
// do. 0 is 0.

/// Smallest code whose value is at least `value`. \pre value >= 0 and finite
inline std::uint16_t encode_up(double value) {
    auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    if (static_cast<double>(std::bit_cast<float>(bits)) < value) ++bits;  // the cast may have rounded down
    return static_cast<std::uint16_t>((bits + 0x7fffu) >> 15);
}

inline float decode(std::uint16_t code) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(code) << 15);
}

}  // namespace relevo::lod
