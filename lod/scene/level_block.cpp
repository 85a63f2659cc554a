#include "lod/scene/level_block.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "lod/scene/block_file.hpp"
#include "lod/scene/level_grid.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/scene/post_mark.hpp"

namespace relevo::lod {
namespace {

constexpr int kSide = LevelGrid::kPosts;

// The bands of vertices, from 1. The two bytes of a code lie in bands of their own: exponents repeat and
// mantissas do not, and coders like them apart.
enum Band { kBounded = 1, kIncremental = 3, kRadius = 5, kClass = 7, kNormal = 8 };
constexpr int kBands = 9;
constexpr unsigned kMantissaMask = (1u << kCodeMantissaBits) - 1;

Error damaged(const std::string& name, const char* what) {
    return {ErrorKind::damaged, fmt::format("{} is damaged: {}", name, what)};
}

template <class T>
Result<std::vector<std::byte>> encode_heights_as(const Raster<float>& heights) {
    std::vector<T> samples(heights.samples().size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const float H = heights.samples()[i];
        bool fits = std::isfinite(H);
        if constexpr (std::is_integral_v<T>) fits = fits && H > kVoidInt16 && H <= -(kVoidInt16 + 1);
        if (fits) samples[i] = static_cast<T>(H);
        if (!fits || static_cast<float>(samples[i]) != H) {
            return Error{ErrorKind::internal,
                         fmt::format("a height of {} m of a mesh does not fit the scene's type", H)};
        }
    }
    return encode_block<T>(samples, {heights.columns(), heights.rows()}, std::nullopt, 0, Effort::little);
}

template <class T>
Result<Raster<float>> decode_heights_as(std::span<const std::byte> bytes, const std::string& name) {
    const auto samples = decode_block<T>(bytes, {kSide, kSide}, name);
    if (!samples) return samples.error();
    Raster<float> heights(kSide, kSide);
    bool finite = true;
    for (std::size_t i = 0; i < samples->size(); ++i) {
        const T sample = (*samples)[i];
        heights.samples()[i] = static_cast<float>(sample);
        if constexpr (std::is_integral_v<T>) {
            finite = finite && sample != kVoidInt16;
        } else {
            finite = finite && std::isfinite(sample);
        }
    }
    if (!finite) return damaged(name, "a post of it has no height");
    return heights;
}

// Most slopes are gentle: a square root keeps them apart in 8 bits, around 127.
constexpr int kFlat = 127;

std::uint8_t companded(std::int16_t component) {
    const double root = std::sqrt(std::abs(component) / 32767.0);
    const auto step = static_cast<int>(std::lround(root * kFlat));
    return static_cast<std::uint8_t>(component < 0 ? kFlat - step : kFlat + step);
}

std::int16_t expanded(std::uint8_t stored) {
    const int step = stored - kFlat;
    const int size = (step * step * 32767 + kFlat * kFlat / 2) / (kFlat * kFlat);
    return static_cast<std::int16_t>(step < 0 ? -size : size);
}

// Half of the rows have codes at odd columns alone. So bands of codes have a row's even columns before its
// odd ones: the zeros lie together, and cost nothing.
constexpr int kEvenColumns = kSide / 2 + 1;

constexpr int column_in_band(int column) {
    return column % 2 == 0 ? column / 2 : kEvenColumns + column / 2;
}

void put_codes(const Raster<std::uint16_t>& codes, std::uint8_t* exponents, std::uint8_t* mantissas) {
    for (int row = 0; row < kSide; ++row, exponents += kSide, mantissas += kSide) {
        for (int column = 0; column < kSide; ++column) {
            const std::uint16_t code = codes.at(column, row);
            exponents[column_in_band(column)] = static_cast<std::uint8_t>(code >> kCodeMantissaBits);
            mantissas[column_in_band(column)] = static_cast<std::uint8_t>(code & kMantissaMask);
        }
    }
}

/// False where the bands hold no codes.
bool take_codes(const std::uint8_t* exponents, const std::uint8_t* mantissas, Raster<std::uint16_t>& codes) {
    unsigned largest = 0;
    unsigned mantissa_bits = 0;
    for (int row = 0; row < kSide; ++row, exponents += kSide, mantissas += kSide) {
        std::uint16_t* to = codes.row(row);
        for (int column = 0; column < kSide; ++column) {
            const int from = column_in_band(column);
            const unsigned code =
                static_cast<unsigned>(exponents[from]) << kCodeMantissaBits | mantissas[from];
            to[column] = static_cast<std::uint16_t>(code);
            largest = std::max(largest, code);
            mantissa_bits |= mantissas[from];
        }
    }
    return largest <= kLargestCode && mantissa_bits <= kMantissaMask;
}

// Along a row a component of the normal changes most along the row, and up a column the other. So the first
// is stored as its difference from the post above, the second as that from the post before, modulo 256. Void
// ones are flat.

/// Calls code(column, row, before) for each post; it returns what stands there for the next one's `before`.
template <class Code>
void for_each_normal(std::size_t axis, const Code& code) {
    std::array<unsigned, kSide> above;
    above.fill(kFlat);
    for (int row = 0; row < kSide; ++row) {
        unsigned left = kFlat;
        for (int column = 0; column < kSide; ++column) {
            unsigned& before = axis == 0 ? above[static_cast<std::size_t>(column)] : left;
            before = code(column, row, before);
        }
    }
}

void put_normals(const Raster<Ground::Normal>& normals, std::size_t axis, std::uint8_t* band) {
    for_each_normal(axis, [&](int column, int row, unsigned before) -> unsigned {
        const unsigned here = companded(normals.at(column, row)[axis]);
        *band++ = static_cast<std::uint8_t>(here - before);
        return here;
    });
}

/// False where the band holds no normals.
bool take_normals(const std::uint8_t* band, const Raster<std::uint8_t>& classes, std::size_t axis,
                  Raster<Ground::Normal>& normals) {
    constexpr unsigned kMost = 2 * kFlat;
    std::array<std::int16_t, 256> values{};
    for (unsigned i = 0; i <= kMost; ++i) values[i] = expanded(static_cast<std::uint8_t>(i));
    bool sound = true;
    for_each_normal(axis, [&](int column, int row, unsigned before) -> unsigned {
        const unsigned here = (before + *band++) & 0xffu;
        const bool is_void = classes.at(column, row) == static_cast<std::uint8_t>(PostClass::void_post);
        sound = sound && here <= kMost && (!is_void || here == kFlat);
        normals.at(column, row)[axis] = values[here];
        return here;
    });
    return sound;
}

}  // namespace

Result<std::vector<std::byte>> encode_level_heights(const Raster<float>& heights, HeightType type) {
    return type == HeightType::int16 ? encode_heights_as<std::int16_t>(heights)
                                     : encode_heights_as<float>(heights);
}

Result<Raster<float>> decode_level_heights(std::span<const std::byte> bytes, HeightType type,
                                           const std::string& name) {
    return type == HeightType::int16 ? decode_heights_as<std::int16_t>(bytes, name)
                                     : decode_heights_as<float>(bytes, name);
}

Result<std::vector<std::byte>> encode_vertices(const MetricRasters& codes, const Ground& ground) {
    constexpr std::size_t kPosts = std::size_t{kSide} * kSide;
    assert(ground.classes.samples().size() == kPosts);
    std::vector<std::uint8_t> samples(kBands * kPosts);
    const auto band = [&](int number) {
        return samples.data() + static_cast<std::size_t>(number - 1) * kPosts;
    };
    put_codes(codes.bounded, band(kBounded), band(kBounded + 1));
    put_codes(codes.incremental, band(kIncremental), band(kIncremental + 1));
    put_codes(codes.radius, band(kRadius), band(kRadius + 1));
    std::ranges::copy(ground.classes.samples(), band(kClass));
    put_normals(ground.normals, 0, band(kNormal));
    put_normals(ground.normals, 1, band(kNormal + 1));
    return encode_block<std::uint8_t>(samples, {kSide, kSide, kBands}, std::nullopt);
}

Result<VertexCodes> decode_codes(std::span<const std::byte> bytes, ErrorMetric metric,
                                 const std::string& name) {
    const int error = metric == ErrorMetric::bounded ? kBounded : kIncremental;
    const std::array bands{error, error + 1, int{kRadius}, kRadius + 1};
    const auto samples = decode_block<std::uint8_t>(bytes, {kSide, kSide, kBands}, name, bands);
    if (!samples) return samples.error();
    VertexCodes codes{Raster<std::uint16_t>(kSide, kSide), Raster<std::uint16_t>(kSide, kSide)};
    const std::size_t count = codes.error.samples().size();
    const std::uint8_t* band = samples->data();
    if (!take_codes(band, band + count, codes.error) ||
        !take_codes(band + 2 * count, band + 3 * count, codes.radius))
        return damaged(name, "its codes are none");
    return codes;
}

Result<Ground> decode_ground(std::span<const std::byte> bytes, const std::string& name) {
    constexpr std::array bands{int{kClass}, int{kNormal}, kNormal + 1};
    const auto samples = decode_block<std::uint8_t>(bytes, {kSide, kSide, kBands}, name, bands);
    if (!samples) return samples.error();
    Ground ground(kSide, kSide);
    const std::size_t count = ground.classes.samples().size();
    const std::uint8_t* band = samples->data();
    std::copy_n(band, count, ground.classes.samples().begin());
    if (std::ranges::max(ground.classes.samples()) > static_cast<std::uint8_t>(PostClass::sea))
        return damaged(name, "its classes are none");
    if (!take_normals(band + count, ground.classes, 0, ground.normals) ||
        !take_normals(band + 2 * count, ground.classes, 1, ground.normals))
        return damaged(name, "its normals are none");
    return ground;
}

}  // namespace relevo::lod
