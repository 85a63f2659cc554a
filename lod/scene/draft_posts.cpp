#include "lod/scene/draft_posts.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "lod/scene/scene_files.hpp"

namespace relevo::lod {
namespace {

constexpr std::uint64_t kBytesOfBlock =
    std::uint64_t{SceneInfo::kBlockSide} * SceneInfo::kBlockSide * (sizeof(float) + sizeof(PostMark));

}  // namespace

DraftPosts::DraftPosts(BlockStore heights, BlockStore marks, const geo::GridFrame& frame,
                       const HeightCoding& coding, std::uint64_t cache_bytes)
    : heights_(std::move(heights)),
      marks_(std::move(marks)),
      frame_(frame),
      coding_(coding),
      grid_(BlockGrid::of_heights(frame.columns, frame.rows)),
      most_cached_(static_cast<std::size_t>(cache_bytes / kBytesOfBlock)),
      cache_(std::make_unique<Cache>()) {}

bool DraftPosts::has(int block_column, int block_row) const {
    // Marks are written last.
    return heights_.has(block_column, block_row) && marks_.has(block_column, block_row);
}

Result<void> DraftPosts::write(int block_column, int block_row, Posts posts) {
    const auto heights = encode_heights(posts.heights, coding_, frame_, grid_.box(block_column, block_row));
    if (!heights) return heights.error();
    if (auto done = heights_.write(block_column, block_row, *heights); !done) return done;
    return finish({block_row, block_column}, std::move(posts));
}

Result<void> DraftPosts::write_marks(int block_column, int block_row, Posts posts,
                                     const DraftPosts& heights_from) {
    assert(codes_as(heights_from));
    if (auto done = heights_.take(block_column, block_row, heights_from.heights_); !done) return done;
    return finish({block_row, block_column}, std::move(posts));
}

Result<void> DraftPosts::finish(Place place, Posts posts) {
    const auto marks = encode_marks(posts.marks, posts.heights);
    if (!marks) return marks.error();
    if (auto done = marks_.write(place.second, place.first, *marks); !done) return done;
    // Where they are stored with loss, what is read differs from what was written.
    if (coding_.max_error_m == 0) keep(place, std::make_shared<const Posts>(std::move(posts)));
    return {};
}

std::shared_ptr<const Posts> DraftPosts::cached(Place place) const {
    const std::lock_guard lock(cache_->mutex);
    const auto found = cache_->blocks.find(place);
    if (found == cache_->blocks.end()) return nullptr;
    cache_->ages.splice(cache_->ages.begin(), cache_->ages, found->second.age);
    return found->second.posts;
}

void DraftPosts::keep(Place place, std::shared_ptr<const Posts> posts) const {
    const std::lock_guard lock(cache_->mutex);
    if (most_cached_ == 0 || cache_->blocks.contains(place)) return;
    if (cache_->blocks.size() >= most_cached_) {
        cache_->blocks.erase(cache_->ages.back());
        cache_->ages.pop_back();
    }
    cache_->ages.push_front(place);
    cache_->blocks[place] = {std::move(posts), cache_->ages.begin()};
}

Result<Posts> DraftPosts::load(int block_column, int block_row) const {
    const BlockGrid::Box box = grid_.box(block_column, block_row);
    const auto name = [&](const char* layer) { return block_file_name(layer, block_column, block_row); };
    const auto heights_bytes = heights_.read(block_column, block_row);
    if (!heights_bytes) return heights_bytes.error();
    const auto marks_bytes = marks_.read(block_column, block_row);
    if (!marks_bytes) return marks_bytes.error();
    auto heights = decode_heights(*heights_bytes, coding_.type, box, name(kHeightsFolder));
    if (!heights) return heights.error();
    auto marks = decode_marks(*marks_bytes, *heights, name(kMarksFolder));
    if (!marks) return marks.error();
    return Posts{std::move(*heights), std::move(*marks)};
}

Result<std::shared_ptr<const Posts>> DraftPosts::read(int block_column, int block_row) const {
    const Place place{block_row, block_column};
    if (auto known = cached(place)) return known;
    auto loaded = load(block_column, block_row);
    if (!loaded) return loaded.error();
    auto posts = std::make_shared<const Posts>(std::move(*loaded));
    keep(place, posts);
    return posts;
}

Result<Posts> DraftPosts::read(const BlockGrid::Box& box) const {
    const int columns = std::clamp(frame_.columns - box.column, 0, box.columns);
    const int rows = std::clamp(frame_.rows - box.row, 0, box.rows);
    Posts posts{Raster<float>(columns, rows), Raster<PostMark>(columns, rows)};
    if (columns == 0 || rows == 0) return posts;
    constexpr int side = SceneInfo::kBlockSide;
    for (int block_row = box.row / side; block_row * side < box.row + rows; ++block_row) {
        for (int block_column = box.column / side; block_column * side < box.column + columns;
             ++block_column) {
            const auto block = read(block_column, block_row);
            if (!block) return block.error();
            const BlockGrid::Box from = grid_.box(block_column, block_row);
            const int left = std::max(from.column, box.column);
            const int right = std::min(from.column + from.columns, box.column + columns);
            const int top = std::max(from.row, box.row);
            const int bottom = std::min(from.row + from.rows, box.row + rows);
            for (int row = top; row < bottom; ++row) {
                std::copy_n((*block)->heights.row(row - from.row) + (left - from.column), right - left,
                            posts.heights.row(row - box.row) + (left - box.column));
                std::copy_n((*block)->marks.row(row - from.row) + (left - from.column), right - left,
                            posts.marks.row(row - box.row) + (left - box.column));
            }
        }
    }
    return posts;
}

}  // namespace relevo::lod
