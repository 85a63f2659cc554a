#include "lod/lstr/chunk_store.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

namespace relevo::lod {

Result<std::unique_ptr<ChunkStore>> ChunkStore::open(const ChunkGroups& groups, const ChunkId& above_root,
                                                     const ChunkStoreOptions& options) {
    std::unique_ptr<ChunkStore> made(new ChunkStore(groups, options));
    made->above_root_ = above_root;
    if (auto done = made->load({above_root}); !done) return done.error();
    return made;
}

ChunkStore::ChunkStore(const ChunkGroups& groups, const ChunkStoreOptions& options)
    : groups_(groups),
      options_(options),
      loader_(
          [&groups, delay_s = options.read_delay_s](const ChunkId& parent) {
              if (delay_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
              return groups.load(parent);
          },
          options.threads) {}

void ChunkStore::take(const ChunkId& parent, Result<ChunkGroup> group) {
    ++figures_.read_groups;
    if (!group) {
        failed_.insert(parent);
        if (!failure_) failure_ = group.error();
        return;
    }
    const std::uint64_t bytes = group->bytes;
    const auto [place, is_new] = residents_.try_emplace(parent, Resident{*std::move(group), frame_});
    if (is_new) bytes_ += bytes;
}

void ChunkStore::start_frame(std::vector<ChunkWish> wishes) {
    while (auto loaded = loader_.take()) take(loaded->key, std::move(loaded->piece));
    ++frame_;
    std::erase_if(wishes, [&](const ChunkWish& wish) { return failed_.contains(wish.parent); });
    std::sort(wishes.begin(), wishes.end(), [](const ChunkWish& a, const ChunkWish& b) {
        return std::tuple(!a.now, a.reach, a.parent) < std::tuple(!b.now, b.reach, b.parent);
    });
    std::vector<ChunkId> missing;
    std::uint64_t wanted = 0;  // by this frame
    std::uint64_t kept = 0;
    figures_.pending_groups = 0;
    for (const ChunkWish& wish : wishes) {
        const auto here = residents_.find(wish.parent);
        const std::uint64_t bytes =
            here == residents_.end() ? groups_.bytes(wish.parent) : here->second.group.bytes;
        if (wish.now) wanted += bytes;
        if (wish.now && here == residents_.end()) ++figures_.pending_groups;
        if (kept + bytes > options_.memory_bytes) continue;
        kept += bytes;
        if (here == residents_.end())
            missing.push_back(wish.parent);
        else
            here->second.kept_in_frame = frame_;
    }
    figures_.memory_load =
        static_cast<double>(wanted) / static_cast<double>(std::max<std::uint64_t>(options_.memory_bytes, 1));
    make_room();
    loader_.request(std::move(missing));
}

/// What has not been wished for the longest goes first.
void ChunkStore::make_room() {
    if (bytes_ <= options_.memory_bytes) return;
    std::vector<std::pair<std::uint64_t, ChunkId>> ages;
    for (const auto& [parent, resident] : residents_) {
        if (resident.kept_in_frame < frame_ && parent != above_root_)
            ages.emplace_back(resident.kept_in_frame, parent);
    }
    std::sort(ages.begin(), ages.end());
    for (const auto& [age, parent] : ages) {
        if (bytes_ <= options_.memory_bytes) return;
        const auto resident = residents_.find(parent);
        bytes_ -= resident->second.group.bytes;
        residents_.erase(resident);
    }
}

Result<void> ChunkStore::load(const std::vector<ChunkId>& parents) {
    std::vector<std::optional<Result<ChunkGroup>>> loaded(parents.size());
    tbb::parallel_for(std::size_t{0}, parents.size(),
                      [&](std::size_t i) { loaded[i] = groups_.load(parents[i]); });
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (!*loaded[i]) return loaded[i]->error();
        take(parents[i], *std::move(loaded[i]));
    }
    return {};
}

ChunkStore::Figures ChunkStore::figures() const {
    Figures figures = figures_;
    figures.resident_bytes = bytes_;
    for (const auto& [parent, resident] : residents_) {
        for (const PlacedChunk& child : resident.group.children)
            figures.resident_nodes += child.vertices.empty() ? 0 : 1;
    }
    return figures;
}

}  // namespace relevo::lod
