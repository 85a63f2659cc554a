#pragma once

#include <cmath>
#include <cstdint>

#include "lod/scene/metric_code.hpp"

// All functions that pass vectors are inlined: there is no ABI that they could change.
#pragma GCC diagnostic ignored "-Wpsabi"
#define RELEVO_INLINE [[gnu::always_inline]] inline

namespace relevo::lod {

// GCC and clang make of these what the machine has. Those with an alignment are for what lies anywhere in
// memory; they are typedefs because in a `using` clang passes over the alignment.
typedef double Four __attribute__((vector_size(32)));
typedef double FourDoubles __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long FourWhole __attribute__((vector_size(32)));
typedef float FourFloats __attribute__((vector_size(16), aligned(4), may_alias));
typedef std::uint16_t FourCodes __attribute__((vector_size(8), aligned(2), may_alias));
typedef std::uint32_t FourWords __attribute__((vector_size(16)));
typedef std::uint8_t EightBytes __attribute__((vector_size(8), aligned(1), may_alias));
typedef std::uint16_t EightCodes __attribute__((vector_size(16), aligned(2), may_alias));

// Number by number: GCC 12 makes one instruction of these, and six of a __builtin_convertvector.

RELEVO_INLINE Four widened(const FourFloats& v) {
    return Four{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]),
                static_cast<double>(v[3])};
}
RELEVO_INLINE Four widened(const float* values) {
    return widened(*reinterpret_cast<const FourFloats*>(values));
}

/// As lod::decode, four at a time.
RELEVO_INLINE Four decoded(const std::uint16_t* codes) {
    const FourWords bits = FourWords{codes[0], codes[1], codes[2], codes[3]} << (23 - kCodeMantissaBits);
    return widened(reinterpret_cast<FourFloats>(bits));
}

/// Two masks: the first in bits 0 to 3, the second in bits 4 to 7.
RELEVO_INLINE unsigned bits_of(FourWhole first, FourWhole second) {
    FourWhole bits = (first & FourWhole{1, 2, 4, 8}) | (second & FourWhole{16, 32, 64, 128});
    bits |= __builtin_shuffle(bits, FourWhole{2, 3, 0, 1});
    bits |= __builtin_shuffle(bits, FourWhole{1, 0, 3, 2});
    return static_cast<unsigned>(bits[0]);
}

RELEVO_INLINE Four root(const Four& v) {
    return Four{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}

}  // namespace relevo::lod
