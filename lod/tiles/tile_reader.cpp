#include "lod/tiles/tile_reader.hpp"

#include <chrono>
#include <utility>

#include "lod/background_thread.hpp"

namespace relevo::lod {

TileReader::TileReader(const Pyramid& pyramid, const geo::PostPositions& positions,
                       const UndulationGrid& undulations, ErrorMetric metric, int threads, double delay_s)
    : pyramid_(pyramid),
      positions_(positions),
      undulations_(undulations),
      metric_(metric),
      delay_s_(delay_s),
      grid_(pyramid.frame()) {
    for (int i = 0; i < threads; ++i)
        threads_.emplace_back([this](const std::stop_token& stop) { run(stop); });
}

TileReader::~TileReader() {
    for (std::jthread& thread : threads_) thread.request_stop();
    work_.notify_all();
}

void TileReader::ask(std::vector<TileWish> wishes, bool whole_blocks) {
    const std::lock_guard lock(mutex_);
    whole_blocks_ = whole_blocks;
    std::erase_if(wishes, [&](const TileWish& wish) { return under_way_.contains(wish.id); });
    queue_ = std::move(wishes);
    if (!queue_.empty()) work_.notify_all();
}

std::vector<TileReader::Arrival> TileReader::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(arrivals_, {});
}

std::vector<TileId> TileReader::tiles_in(const PyramidBlock& block) const {
    constexpr int across = Pyramid::kBlockCells / TileGrid::kCells;
    std::vector<TileId> tiles;
    for (int row = across * block.row; row < across * (block.row + 1); ++row) {
        for (int column = across * block.column; column < across * (block.column + 1); ++column) {
            if (const TileId id{block.level, column, row}; grid_.contains(id) && grid_.holds_data(id))
                tiles.push_back(id);
        }
    }
    return tiles;
}

/// Reads the block of the most urgent tile, and makes all tiles that are wanted of it. \pre the lock is held;
/// it is not while the block is read
bool TileReader::read_next(std::unique_lock<std::mutex>& lock) {
    if (queue_.empty()) return false;
    const PyramidBlock block = pyramid_block(grid_, queue_.back().id);
    Arrival arrival;
    std::erase_if(queue_, [&](const TileWish& wish) {
        if (pyramid_block(grid_, wish.id) != block) return false;
        arrival.asked.push_back(wish.id);
        return true;
    });
    const std::vector<TileId> tiles = whole_blocks_ ? tiles_in(block) : arrival.asked;
    under_way_.insert(tiles.begin(), tiles.end());
    ++read_blocks_;

    lock.unlock();
    if (delay_s_ > 0) std::this_thread::sleep_for(std::chrono::duration<double>(delay_s_));
    if (const auto posts = pyramid_.read_vertices(block, metric_)) {
        for (const TileId& id : tiles)
            arrival.tiles.emplace_back(grid_, id, block, *posts, positions_, undulations_);
    } else {
        arrival.failure = posts.error();
    }
    lock.lock();

    for (const TileId& id : tiles) under_way_.erase(id);
    arrivals_.push_back(std::move(arrival));
    news_.notify_all();
    return true;
}

void TileReader::run(const std::stop_token& stop) {
    stand_back();
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        if (!read_next(lock)) work_.wait(lock, stop, [&] { return !queue_.empty(); });
    }
}

bool TileReader::wait() {
    std::unique_lock lock(mutex_);
    if (threads_.empty()) return read_next(lock);
    if (arrivals_.empty() && queue_.empty() && under_way_.empty()) return false;
    news_.wait(lock, [&] { return !arrivals_.empty(); });
    return true;
}

std::uint64_t TileReader::read_blocks() const {
    const std::lock_guard lock(mutex_);
    return read_blocks_;
}

}  // namespace relevo::lod
