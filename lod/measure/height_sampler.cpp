#include "lod/measure/height_sampler.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace relevo::lod {
namespace {

/// The posts around a coordinate along one axis: the same one twice within the tolerance of it.
std::pair<int, int> posts_around(double coordinate) {
    const double nearest = std::round(coordinate);
    if (std::abs(coordinate - nearest) <= HeightSampler::kPostTolerance)
        return {static_cast<int>(nearest), static_cast<int>(nearest)};
    const int before = static_cast<int>(std::floor(coordinate));
    return {before, before + 1};
}

}  // namespace

geo::GridPosition HeightSampler::on_seam(geo::GridPosition place) const {
    const geo::GridFrame& frame = scene_.info().frame;
    const double last = frame.columns - 1;
    if (frame.closes() && place.column > -0.5 && place.column < last + 0.5)
        place.column = std::clamp(place.column, 0.0, last);
    return place;
}

bool HeightSampler::inside(geo::GridPosition place) const {
    place = on_seam(place);
    const geo::GridFrame& frame = scene_.info().frame;
    return place.column >= -kPostTolerance && place.column <= frame.columns - 1 + kPostTolerance &&
           place.row >= -kPostTolerance && place.row <= frame.rows - 1 + kPostTolerance;
}

Result<HeightSampler::CachedBlock*> HeightSampler::block(int block_column, int block_row) {
    const std::uint64_t key =
        static_cast<std::uint64_t>(block_row) << 32 | static_cast<std::uint32_t>(block_column);
    if (const auto known = blocks_.find(key); known != blocks_.end()) {
        ages_.splice(ages_.begin(), ages_, known->second.age);
        return &known->second;
    }
    auto heights = scene_.read_heights(block_column, block_row);
    if (!heights) return heights.error();
    if (blocks_.size() == kMaxBlocks) {
        blocks_.erase(ages_.back());
        ages_.pop_back();
    }
    ages_.push_front(key);
    const auto added = blocks_.emplace(key, CachedBlock{*std::move(heights), {}, ages_.begin()}).first;
    return &added->second;
}

Result<std::optional<double>> HeightSampler::post(int column, int row) {
    assert(column >= 0 && column < scene_.info().frame.columns && row >= 0 && row < scene_.info().frame.rows);
    constexpr int kSide = SceneInfo::kBlockSide;
    const auto around = block(column / kSide, row / kSide);
    if (!around) return around.error();
    const float height = (*around)->heights.at(column % kSide, row % kSide);
    if (std::isnan(height)) return std::optional<double>{};
    return std::optional<double>{static_cast<double>(height)};
}

Result<PostMark> HeightSampler::mark(int column, int row) {
    constexpr int kSide = SceneInfo::kBlockSide;
    const auto around = block(column / kSide, row / kSide);
    if (!around) return around.error();
    CachedBlock& known = **around;
    if (!known.marks) {
        auto marks = scene_.read_marks(column / kSide, row / kSide, known.heights);
        if (!marks) return marks.error();
        known.marks = *std::move(marks);
    }
    return known.marks->at(column % kSide, row % kSide);
}

Result<std::optional<PlaceMarks>> HeightSampler::marks(geo::GridPosition place) {
    const auto surface = cell(place);
    if (!surface) return surface.error();
    if (!*surface) return std::optional<PlaceMarks>{};
    place = on_seam(place);
    const auto [west, east] = posts_around(place.column);
    const auto [north, south] = posts_around(place.row);
    PlaceMarks marks;
    for (const int row : {north, south}) {
        for (const int column : {west, east}) {
            const auto here = mark(column, row);
            if (!here) return here.error();
            marks.filled |= here->filled();
            marks.modelled |= here->modelled();
            if (column == static_cast<int>(std::round(place.column)) &&
                row == static_cast<int>(std::round(place.row)))
                marks.nearest = *here;
        }
    }
    return std::optional{marks};
}

Result<std::optional<BilinearCell>> HeightSampler::cell(geo::GridPosition place) {
    place = on_seam(place);
    if (!inside(place)) return std::optional<BilinearCell>{};
    const auto [west, east] = posts_around(place.column);
    const auto [north, south] = posts_around(place.row);
    BilinearCell cell{.column = west, .row = north};
    const std::array<std::pair<double*, std::pair<int, int>>, 4> corners{{{&cell.nw, {west, north}},
                                                                          {&cell.ne, {east, north}},
                                                                          {&cell.sw, {west, south}},
                                                                          {&cell.se, {east, south}}}};
    for (const auto& [height, where] : corners) {
        const auto H = post(where.first, where.second);
        if (!H) return H.error();
        if (!*H) return std::optional<BilinearCell>{};
        *height = **H;
    }
    return std::optional{cell};
}

Result<std::optional<double>> HeightSampler::height(geo::GridPosition place) {
    const auto around = cell(place);
    if (!around) return around.error();
    if (!*around) return std::optional<double>{};
    return std::optional<double>{(*around)->height(place)};
}

}  // namespace relevo::lod
