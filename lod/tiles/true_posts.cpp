#include "lod/tiles/true_posts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relevo::lod {

float TruePosts::Reader::H(int column, int row) {
    const geo::GridFrame& frame = posts_.pyramid_.frame();
    if (column < 0 || row < 0 || column >= frame.columns || row >= frame.rows)
        return std::numeric_limits<float>::quiet_NaN();
    constexpr int kCells = Pyramid::kBlockCells;
    // The last post of a grid of whole blocks is the last of the last one.
    const int last = std::max(((1 << frame.levels()) / kCells) - 1, 0);
    const int block_column = std::min(column / kCells, last);
    const int block_row = std::min(row / kCells, last);
    Held& held = held_[static_cast<std::size_t>(2 * (block_row & 1) + (block_column & 1))];
    if (held.column != block_column || held.row != block_row)
        held = {block_column, block_row, posts_.block(block_column, block_row)};
    return held.block->at(column - kCells * block_column, row - kCells * block_row);
}

bool TruePosts::Reader::is_valid(int column, int row) {
    return !std::isnan(H(column, row));
}

bool TruePosts::Reader::is_valid_cell(int column, int row) {
    return is_valid(column, row) && is_valid(column + 1, row) && is_valid(column, row + 1) &&
           is_valid(column + 1, row + 1);
}

TruePosts::Block TruePosts::block(int column, int row) const {
    const Place place{row, column};
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = kept_.find(place); known != kept_.end()) {
            by_age_.splice(by_age_.begin(), by_age_, known->second.age);
            return known->second.block;
        }
    }
    auto ground = pyramid_.read_ground({0, column, row});
    const int side = std::min(Pyramid::kBlockCells, 1 << pyramid_.frame().levels()) + 1;
    Block read =
        ground ? std::make_shared<const Raster<float>>(std::move(ground->heights))
               : std::make_shared<const Raster<float>>(side, side, std::numeric_limits<float>::quiet_NaN());

    const std::lock_guard lock(mutex_);
    if (!ground && !failure_) failure_ = ground.error();
    if (const auto known = kept_.find(place); known != kept_.end()) return known->second.block;
    const auto bytes_of = [](const Block& block) { return block->samples().size() * sizeof(float); };
    by_age_.push_front(place);
    kept_[place] = {read, by_age_.begin()};
    bytes_ += bytes_of(read);
    while (bytes_ > memory_bytes_ && by_age_.size() > 1) {
        const auto oldest = kept_.find(by_age_.back());
        bytes_ -= bytes_of(oldest->second.block);
        kept_.erase(oldest);
        by_age_.pop_back();
    }
    return read;
}

std::optional<Error> TruePosts::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

}  // namespace relevo::lod
