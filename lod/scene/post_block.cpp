#include "lod/scene/post_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "lod/scene/block_file.hpp"
#include "lod/scene/scene_files.hpp"

namespace relevo::lod {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

/// The stored form of a height; false where the type cannot hold it.
bool store(float height, std::int16_t& sample) {
    if (std::isnan(height)) {
        sample = kVoidInt16;
        return true;
    }
    if (!(height > kVoidInt16 && height <= std::numeric_limits<std::int16_t>::max())) return false;
    sample = static_cast<std::int16_t>(height);
    return static_cast<float>(sample) == height;
}

bool store(float height, float& sample) {
    sample = std::isnan(height) ? kVoid : height;  // one NaN: others differ in bits that nobody means
    return !std::isinf(height);
}

float height_from(std::int16_t sample) {
    return sample == kVoidInt16 ? kVoid : static_cast<float>(sample);
}
float height_from(float sample) {
    return sample;
}

template <class T>
Result<std::vector<std::byte>> encode(const Raster<float>& heights, double max_error,
                                      const GeoReference& where) {
    std::vector<T> samples(heights.samples().size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!store(heights.samples()[i], samples[i])) {
            return Error{ErrorKind::internal,
                         fmt::format("a height of {} m does not fit the scene's type", heights.samples()[i])};
        }
    }
    return encode_block<T>(samples, {heights.columns(), heights.rows()}, where, max_error);
}

template <class T>
Result<Raster<float>> decode_as(std::span<const std::byte> bytes, const BlockGrid::Box& box,
                                const std::string& name) {
    const Result<std::vector<T>> samples = decode_block<T>(bytes, {box.columns, box.rows}, name);
    if (!samples) return samples.error();
    Raster<float> heights(box.columns, box.rows);
    std::ranges::transform(*samples, heights.samples().begin(), [](T sample) { return height_from(sample); });
    if (std::ranges::any_of(heights.samples(), [](float H) { return std::isinf(H); }))
        return Error{ErrorKind::damaged, fmt::format("{} is damaged: it has an infinite height", name)};
    return heights;
}

PostMark plain_mark(float height) {
    return std::isnan(height) ? PostMark{} : PostMark{PostClass::land, 0};
}

}  // namespace

Result<std::vector<std::byte>> encode_heights(const Raster<float>& heights, const HeightCoding& coding,
                                              const geo::GridFrame& frame, const BlockGrid::Box& box) {
    if (std::ranges::all_of(heights.samples(), [](float H) { return std::isnan(H); }))
        return std::vector<std::byte>{};
    const GeoReference where = geo_reference(frame, box.column, box.row);
    return coding.type == HeightType::int16
               ? encode<std::int16_t>(heights, std::floor(coding.max_error_m), where)
               : encode<float>(heights, coding.max_error_m, where);
}

Result<Raster<float>> decode_heights(std::span<const std::byte> bytes, HeightType type,
                                     const BlockGrid::Box& box, const std::string& name) {
    if (bytes.empty()) return Raster<float>(box.columns, box.rows, kVoid);
    return type == HeightType::int16 ? decode_as<std::int16_t>(bytes, box, name)
                                     : decode_as<float>(bytes, box, name);
}

Raster<PostMark> plain_marks(const Raster<float>& heights) {
    Raster<PostMark> marks(heights.columns(), heights.rows());
    std::ranges::transform(heights.samples(), marks.samples().begin(), plain_mark);
    return marks;
}

Result<std::vector<std::byte>> encode_marks(const Raster<PostMark>& marks, const Raster<float>& heights) {
    if (marks.samples() == plain_marks(heights).samples()) return std::vector<std::byte>{};
    std::vector<std::uint16_t> bits(marks.samples().size());
    std::ranges::transform(marks.samples(), bits.begin(), [](PostMark mark) { return mark.bits(); });
    return encode_block<std::uint16_t>(bits, {marks.columns(), marks.rows()}, std::nullopt);
}

Result<Raster<PostMark>> decode_marks(std::span<const std::byte> bytes, const Raster<float>& heights,
                                      const std::string& name) {
    if (bytes.empty()) return plain_marks(heights);
    const auto bits = decode_block<std::uint16_t>(bytes, {heights.columns(), heights.rows()}, name);
    if (!bits) return bits.error();
    Raster<PostMark> marks(heights.columns(), heights.rows());
    for (std::size_t i = 0; i < bits->size(); ++i) {
        const PostMark mark((*bits)[i]);
        const bool known = mark.post_class() <= PostClass::sea;
        if (!known || mark.is_void() != std::isnan(heights.samples()[i])) {
            return Error{ErrorKind::damaged,
                         fmt::format("{} is damaged: its marks do not fit the heights", name)};
        }
        marks.samples()[i] = mark;
    }
    return marks;
}

}  // namespace relevo::lod
