#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>

#include "geo/result.hpp"

namespace relevo::lod {

/// Blocks that were read lately, up to a bound of bytes. For several threads; none waits for another's
/// reading, so that two who want the same block at once may both read it.
template <class Key, class Block>
class BlockCache {
  public:
    explicit BlockCache(std::uint64_t bytes) : most_bytes_(bytes) {}

    /// The block of a key, read by `read` (which gives Result<Block>) if it is not here.
    template <class Read>
    Result<std::shared_ptr<const Block>> get(const Key& key, std::uint64_t bytes, const Read& read) {
        if (auto known = find(key)) return known;
        auto loaded = read();
        if (!loaded) return loaded.error();
        auto block = std::make_shared<const Block>(*std::move(loaded));
        keep(key, bytes, block);
        return block;
    }

  private:
    struct Entry {
        std::shared_ptr<const Block> block;
        std::uint64_t bytes;
        typename std::list<Key>::iterator age;
    };

    std::shared_ptr<const Block> find(const Key& key) {
        const std::lock_guard lock(mutex_);
        const auto found = entries_.find(key);
        if (found == entries_.end()) return nullptr;
        ages_.splice(ages_.begin(), ages_, found->second.age);
        return found->second.block;
    }

    void keep(const Key& key, std::uint64_t bytes, const std::shared_ptr<const Block>& block) {
        const std::lock_guard lock(mutex_);
        if (entries_.contains(key)) return;
        ages_.push_front(key);
        entries_[key] = {block, bytes, ages_.begin()};
        bytes_ += bytes;
        while (bytes_ > most_bytes_) {
            const auto oldest = entries_.find(ages_.back());
            bytes_ -= oldest->second.bytes;
            entries_.erase(oldest);
            ages_.pop_back();
        }
    }

    std::uint64_t most_bytes_;
    std::mutex mutex_;
    std::uint64_t bytes_ = 0;
    std::map<Key, Entry> entries_;
    std::list<Key> ages_;  // the last used first
};

}  // namespace relevo::lod
