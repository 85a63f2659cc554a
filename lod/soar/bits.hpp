#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "lod/soar/four.hpp"

namespace relevo::lod {

/// A row of up to 64 places, a bit each.
using Bits = std::uint64_t;

RELEVO_INLINE Bits first_bits(int count) {
    return (Bits{1} << count) - 1;
}

RELEVO_INLINE int next_bit(Bits& bits) {
    const int at = std::countr_zero(bits);
    bits &= bits - 1;
    return at;
}

namespace bits_detail {

/// Of each byte the places of its bits, then zeros.
inline constexpr auto kPlaces = [] {
    std::array<std::array<std::uint8_t, 8>, 256> places{};
    for (unsigned byte = 0; byte < 256; ++byte) {
        std::size_t count = 0;
        for (std::uint8_t at = 0; at < 8; ++at) {
            if ((byte >> at & 1) != 0) places[byte][count++] = at;
        }
    }
    return places;
}();

}  // namespace bits_detail

/// Writes `first` plus each of a byte's bits' places and returns the end of these; what is behind it, up to
/// eight numbers after `to`, is overwritten. Without a branch: in loops over the bits of many rows it is the
/// ends of the rows, which nobody can foresee, that take the time.
RELEVO_INLINE std::uint16_t* list_byte(unsigned byte, int first, std::uint16_t* to) {
    const auto* places = reinterpret_cast<const EightBytes*>(bits_detail::kPlaces[byte].data());
    *reinterpret_cast<EightCodes*>(to) =
        __builtin_convertvector(*places, EightCodes) + static_cast<std::uint16_t>(first);
    return to + std::popcount(byte);
}

/// The same for the first 32 bits.
RELEVO_INLINE std::uint16_t* list_bits(Bits bits, int first, std::uint16_t* to) {
    for (int byte = 0; byte < 4; ++byte)
        to = list_byte(static_cast<unsigned>(bits >> (8 * byte) & 0xff), first + 8 * byte, to);
    return to;
}

/// Of 32 bits, which groups of four hold one: 8 bits.
RELEVO_INLINE unsigned fours_with_any(std::uint32_t bits) {
    bits |= bits >> 2;
    bits |= bits >> 1;
    bits &= 0x11111111;
    bits = (bits | bits >> 3) & 0x03030303;
    bits = (bits | bits >> 6) & 0x000f000f;
    return (bits | bits >> 12) & 0xff;
}

}  // namespace relevo::lod
