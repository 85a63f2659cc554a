// Bytes as the files of a scene: the first says which, the second the sides of a block (where it has not one
// size), the rest is the file. With RELEVO_FUZZ_GOOD in the environment all must be accepted: a seed that is
// refused leads nowhere.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lod/scene/geoid_block.hpp"
#include "lod/scene/level_block.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/scene/post_block.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/scene_info.hpp"

namespace {

using namespace relevo;

// Each of these says whether what it was given was accepted.

/// What has been read and found good must come back from what is written of it.
bool read_scene_json(const std::string& text) {
    const bool whole = bool(lod::scene_info_from_text(text));  // seldom: damage spoils the checksum
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return whole;
    const auto info = lod::scene_info_from_json(json);
    if (!info) return whole;
    const auto again = lod::scene_info_from_text(lod::scene_text(*info));
    if (!again) {
        fmt::print(stderr, "written, but not read again: {}\n", again.error().message);
        std::abort();
    }
    return whole;
}

bool read_heights(std::span<const std::byte> bytes, lod::HeightType type, int side) {
    const auto heights = lod::decode_heights(bytes, type, {0, 0, side, side}, "block");
    if (!heights) return false;
    if (heights->columns() != side || heights->rows() != side) std::abort();
    for (const float H : heights->samples())
        if (std::isinf(H)) std::abort();
    return true;
}

/// Over heights of which the first is void, as in the scene that seeds come from.
bool read_marks(std::span<const std::byte> bytes, int side) {
    lod::Raster<float> heights(side, side);
    heights.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    const auto marks = lod::decode_marks(bytes, heights, "block");
    if (!marks) return false;
    for (std::size_t i = 0; i < heights.samples().size(); ++i)
        if (marks->samples()[i].is_void() != std::isnan(heights.samples()[i])) std::abort();
    return true;
}

bool read_level_heights(std::span<const std::byte> bytes, lod::HeightType type) {
    const auto heights = lod::decode_level_heights(bytes, type, "block");
    if (!heights) return false;
    for (const float H : heights->samples())
        if (!std::isfinite(H)) std::abort();
    return true;
}

bool read_vertices(std::span<const std::byte> bytes) {
    bool accepted = true;
    for (const auto metric : {lod::ErrorMetric::bounded, lod::ErrorMetric::incremental}) {
        const auto codes = lod::decode_codes(bytes, metric, "block");
        accepted = accepted && codes;
        if (!codes) continue;
        for (const auto* layer : {&codes->error, &codes->radius})
            for (const std::uint16_t code : layer->samples())
                if (code > lod::kLargestCode) std::abort();
    }
    const auto ground = lod::decode_ground(bytes, "block");
    if (!ground) return false;
    for (std::size_t i = 0; i < ground->classes.samples().size(); ++i) {
        const auto known = static_cast<lod::PostClass>(ground->classes.samples()[i]);
        const bool is_flat = ground->normals.samples()[i] == lod::Ground::Normal{};
        if (known > lod::PostClass::sea || (known == lod::PostClass::void_post && !is_flat)) std::abort();
    }
    return accepted;
}

bool read_geoid(std::span<const std::byte> bytes, int side) {
    const lod::GeoidInfo where{{}, 40, 5, 0.25, 0.25, side, side};
    const auto geoid = lod::decode_geoid(bytes, where, "block");
    if (!geoid) return false;
    for (const double lat : {40.0, 41.1, 90.0})
        for (const double lon : {5.0, 6.1, -100.0})
            if (!std::isfinite(geoid->undulation({geo::Degrees{lat}, geo::Degrees{lon}}).m)) std::abort();
    return true;
}

bool read(std::uint8_t kind, int side, std::span<const std::byte> bytes) {
    switch (kind) {
        case 'i':
            return read_heights(bytes, lod::HeightType::int16, side);
        case 'f':
            return read_heights(bytes, lod::HeightType::float32, side);
        case 'm':
            return read_marks(bytes, side);
        case 'I':
            return read_level_heights(bytes, lod::HeightType::int16);
        case 'F':
            return read_level_heights(bytes, lod::HeightType::float32);
        case 'v':
            return read_vertices(bytes);
        case 'g':
            return read_geoid(bytes, side);
        default:
            return read_scene_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool must_be_good = std::getenv("RELEVO_FUZZ_GOOD") != nullptr;
    if (size < 2) return 0;
    const bool accepted = read(data[0], data[1] + 1, std::as_bytes(std::span(data + 2, size - 2)));
    if (must_be_good && !accepted) std::abort();
    return 0;
}
