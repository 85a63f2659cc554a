#include "lod/tiles/tile_store.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <iterator>
#include <utility>

namespace relevo::lod {

Result<std::unique_ptr<TileStore>> TileStore::open(const Pyramid& pyramid,
                                                   const geo::PostPositions& positions,
                                                   const UndulationGrid& undulations, ErrorMetric metric,
                                                   const TileStoreOptions& options) {
    std::unique_ptr<TileStore> store(new TileStore(pyramid, positions, undulations, metric, options));
    const TileGrid& grid = store->grid_;
    const PyramidBlock block = pyramid_block(grid, grid.root());
    const auto posts = pyramid.read_vertices(block, metric);
    if (!posts) return posts.error();

    for (int level = grid.levels - 1; level >= pyramid.top(); --level) {
        for (int row = 0; row < grid.across(level); ++row) {
            for (int column = 0; column < grid.across(level); ++column) {
                const TileId id{level, column, row};
                if (!grid.holds_data(id)) continue;
                auto tile = std::make_unique<Resident>(
                    Resident{.tile = Tile(grid, id, block, *posts, positions, undulations)});
                tile->presence = 1;
                tile->side_presence = {1, 1, 1, 1};
                store->slot(id) = std::move(tile);
            }
        }
    }
    const int last = 1 << grid.levels;
    const int in_block = posts->heights.columns() - 1;
    const GridPoint corners[] = {{0, 0}, {0, last}, {last, last}, {last, 0}};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& [column, row] = corners[k];
        const auto H = posts->heights.at(column == 0 ? 0 : in_block, row == 0 ? 0 : in_block);
        store->corners_[k] = {corners[k], static_cast<double>(H), undulations.at(column, row)};
    }
    return store;
}

TileStore::TileStore(const Pyramid& pyramid, const geo::PostPositions& positions,
                     const UndulationGrid& undulations, ErrorMetric metric, const TileStoreOptions& options)
    : options_(options),
      grid_(pyramid.frame()),
      reader_(pyramid, positions, undulations, metric, options.threads, options.read_delay_s) {
    for (int level = 0; level < grid_.levels; ++level) {
        across_.push_back(grid_.across(level));
        levels_.emplace_back(static_cast<std::size_t>(across_.back()) *
                             static_cast<std::size_t>(across_.back()));
    }
}

template <class Visit>
void TileStore::for_each_dependence(const TileId& id, Visit visit) const {
    if (id == grid_.root()) return;
    const TileId parent = grid_.parent(id);
    visit(parent);
    if (grid_.across(id.level) == grid_.across(parent.level)) return;  // the only tile of its level
    const TileId beside[] = {{parent.level, parent.column + (id.column % 2 == 0 ? -1 : 1), parent.row},
                             {parent.level, parent.column, parent.row + (id.row % 2 == 0 ? -1 : 1)}};
    for (const TileId& neighbour : beside) {
        if (grid_.contains(neighbour) && grid_.holds_data(neighbour)) visit(neighbour);
    }
}

void TileStore::start_frame() {
    if (used_.exchange(false)) {
        last_drawn_ = frame_++;
        keep_dependences();
    }
    // Before anything is taken in: what the last frame missed it missed, even if it has come since.
    std::vector<TileWish> wishes = take_wishes();
    std::vector<TileReader::Arrival> arrivals = reader_.take();
    const bool changed = !arrivals.empty();
    take_in(std::move(arrivals));
    if (changed || fading_) update_presence();
    pass_on(std::move(wishes));
}

void TileStore::take_in(std::vector<TileReader::Arrival> arrivals) {
    std::size_t bytes = 0;
    for (const TileReader::Arrival& arrival : arrivals) {
        for (const Tile& tile : arrival.tiles) bytes += tile.bytes();
    }
    if (resident_bytes_ + bytes > options_.memory_bytes) make_room(bytes);
    const auto now = Clock::now();
    for (TileReader::Arrival& arrival : arrivals) {
        if (arrival.failure) {
            failed_.insert(arrival.asked.begin(), arrival.asked.end());
            if (!failure_) failure_ = std::move(arrival.failure);
        }
        for (Tile& tile : arrival.tiles) {
            auto& place = slot(tile.id());
            if (place || resident_bytes_ + tile.bytes() > options_.memory_bytes) continue;
            resident_bytes_ += tile.bytes();
            place = std::make_unique<Resident>(
                Resident{.tile = std::move(tile), .arrived = now, .used_in_frame = last_drawn_});
            residents_.push_back(place.get());
        }
    }
    std::stable_sort(residents_.begin(), residents_.end(), [](const Resident* a, const Resident* b) {
        return a->tile.id().level > b->tile.id().level;
    });
}

/// What a drawn tile depends on is drawn with, too.
void TileStore::keep_dependences() {
    // Finest first: what a kept tile depends on is marked before it is met.
    for (auto at = residents_.rbegin(); at != residents_.rend(); ++at) {
        if ((*at)->used_in_frame < last_drawn_) continue;
        for_each_dependence((*at)->tile.id(), [&](const TileId& id) {
            if (Resident* other = slot(id).get()) other->used_in_frame = last_drawn_;
        });
    }
}

/// Drops tiles that the last frame did not draw with, those first that have not been used for longest.
void TileStore::make_room(std::size_t bytes) {
    keep_dependences();  // also of what has come and was not drawn yet
    std::vector<Resident*> idle;
    std::copy_if(residents_.rbegin(), residents_.rend(), std::back_inserter(idle),
                 [&](const Resident* tile) { return tile->used_in_frame < last_drawn_; });
    std::stable_sort(idle.begin(), idle.end(), [](const Resident* a, const Resident* b) {
        return a->used_in_frame < b->used_in_frame;
    });
    std::set<const Resident*> gone;
    for (const Resident* tile : idle) {
        if (resident_bytes_ + bytes <= options_.memory_bytes) break;
        resident_bytes_ -= tile->tile.bytes();
        gone.insert(tile);
    }
    std::erase_if(residents_, [&](const Resident* tile) { return gone.contains(tile); });
    for (const Resident* tile : gone) slot(tile->tile.id()).reset();
}

void TileStore::update_presence() {
    const auto now = Clock::now();
    fading_ = false;
    const auto presence_of = [&](const TileId& id) {
        if (!grid_.contains(id) || !grid_.holds_data(id)) return 1.0;
        const Resident* tile = slot(id).get();
        return tile == nullptr ? 0.0 : tile->presence;
    };
    for (Resident* tile : residents_) {  // coarsest first
        const double age_s = std::chrono::duration<double>(now - tile->arrived).count();
        double presence = age_s >= options_.fade_s ? 1 : age_s / options_.fade_s;
        fading_ = fading_ || presence < 1;
        for_each_dependence(tile->tile.id(),
                            [&](const TileId& id) { presence = std::min(presence, presence_of(id)); });
        tile->presence = presence;
    }
    for (Resident* tile : residents_) {
        const auto& [level, column, row] = tile->tile.id();
        const TileId beside[] = {{level, column, row - 1},
                                 {level, column, row + 1},
                                 {level, column - 1, row},
                                 {level, column + 1, row}};
        for (std::size_t k = 0; k < 4; ++k)
            tile->side_presence[k] = std::min(tile->presence, presence_of(beside[k]));
    }
}

void TileStore::use(const Resident& tile) const {
    if (!used_.load(std::memory_order_relaxed)) used_.store(true, std::memory_order_relaxed);
    std::atomic_ref<std::uint64_t>(const_cast<Resident&>(tile).used_in_frame)
        .store(frame_, std::memory_order_relaxed);
}

void TileStore::want(const TileId& id, double urgency, TileNeed need) const {
    if (!grid_.holds_data(id)) return;
    if (slot(id) == nullptr) {
        const std::lock_guard lock(wishes_mutex_);
        wishes_.push_back({id, urgency, need});
    }
    // It may be there and have to wait for what it depends on, and that again.
    for_each_dependence(id, [&](const TileId& other) {
        if (find(other) == nullptr) want(other, urgency * 1.001, need);
    });
}

/// What the last frame missed, the most pressing last.
std::vector<TileWish> TileStore::take_wishes() {
    std::vector<TileWish> wishes;
    {
        const std::lock_guard lock(wishes_mutex_);
        wishes.swap(wishes_);
    }
    std::erase_if(wishes, [&](const TileWish& wish) { return slot(wish.id) || failed_.contains(wish.id); });
    // One wish a tile, the most pressing.
    const auto presses_less = [](const TileWish& a, const TileWish& b) {
        return a.need != b.need ? a.need == TileNeed::soon : a.urgency < b.urgency;
    };
    std::sort(wishes.begin(), wishes.end(), [&](const TileWish& a, const TileWish& b) {
        return a.id != b.id ? a.id < b.id : presses_less(b, a);
    });
    wishes.erase(std::unique(wishes.begin(), wishes.end(),
                             [](const TileWish& a, const TileWish& b) { return a.id == b.id; }),
                 wishes.end());
    std::sort(wishes.begin(), wishes.end(), presses_less);
    pending_ = static_cast<std::size_t>(std::count_if(
        wishes.begin(), wishes.end(), [](const TileWish& wish) { return wish.need == TileNeed::now; }));
    return wishes;
}

/// Tells the readers what to read.
void TileStore::pass_on(std::vector<TileWish> wishes) {
    std::erase_if(wishes, [&](const TileWish& wish) { return slot(wish.id) || failed_.contains(wish.id); });
    const auto needed = std::count_if(wishes.begin(), wishes.end(),
                                      [](const TileWish& wish) { return wish.need == TileNeed::now; });
    // What would have to make room for itself only to be dropped again is not read.
    std::size_t in_use = 0;
    for (const Resident* tile : residents_) {
        if (tile->used_in_frame >= last_drawn_) in_use += tile->tile.bytes();
    }
    const std::size_t tile_bytes = sizeof(Resident) + std::size_t{40} * 1024;
    const std::size_t room =
        options_.memory_bytes > in_use ? (options_.memory_bytes - in_use) / tile_bytes : 0;
    memory_load_ = static_cast<double>(in_use + static_cast<std::size_t>(needed) * tile_bytes) /
                   static_cast<double>(options_.memory_bytes);
    if (wishes.size() > room) wishes.erase(wishes.begin(), wishes.end() - static_cast<std::ptrdiff_t>(room));

    const bool has_spare_room = resident_bytes_ + 64 * tile_bytes < options_.memory_bytes / 4 * 3;
    reader_.ask(std::move(wishes), has_spare_room);
}

std::optional<Error> TileStore::failure() const {
    return failure_;
}

TileStore::Figures TileStore::figures() const {
    return {resident_bytes_, residents_.size(), pending_, memory_load_, reader_.read_blocks()};
}

}  // namespace relevo::lod
