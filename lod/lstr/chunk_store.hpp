#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "geo/result.hpp"
#include "lod/background_loader.hpp"
#include "lod/lstr/chunk_group.hpp"

namespace relevo::lod {

/// How nodes are kept and loaded.
struct ChunkStoreOptions {
    std::uint64_t memory_bytes = std::uint64_t{256} << 20;  ///< of nodes; the root comes on top
    int threads = 1;                                        ///< that read
    double read_delay_s = 0;                                ///< added to each read, for trials
};

/// A group of nodes that is, or may soon be, of use.
struct ChunkWish {
    ChunkId parent;
    bool now = false;  ///< the frame under way would draw with it
    /// Its parent's distance over that at which it is needed: smaller is more urgent.
    double reach = 0;
};

/// The groups of nodes that are in memory, bounded, and those that are on their way. Between two calls of
/// start_frame() what is there does not change. For one thread.
class ChunkStore {
  public:
    /// Reads the root. The groups must outlive this.
    static Result<std::unique_ptr<ChunkStore>> open(const ChunkGroups& groups, const ChunkId& above_root,
                                                    const ChunkStoreOptions& options);

    /// Takes in what has been read; reads and keeps what is wished for, the most urgent first, as far as
    /// there is room; lets go of the rest where there is none.
    void start_frame(std::vector<ChunkWish> wishes);

    /// Null: not in memory.
    const ChunkGroup* find(const ChunkId& parent) const {
        const auto found = residents_.find(parent);
        return found == residents_.end() ? nullptr : &found->second.group;
    }

    /// Reads groups now, whether there is room or not.
    Result<void> load(const std::vector<ChunkId>& parents);

    struct Figures {
        std::uint64_t resident_bytes = 0;
        std::size_t resident_nodes = 0;
        std::size_t pending_groups = 0;  ///< wished for now and not there
        double memory_load = 0;          ///< what the last frame wants, over the memory
        std::uint64_t read_groups = 0;   ///< since the start
    };
    Figures figures() const;

    /// The first read that failed. Its nodes stay away: the ground is drawn as coarse as their parents.
    const std::optional<Error>& failure() const { return failure_; }

  private:
    struct Resident {
        ChunkGroup group;
        std::uint64_t kept_in_frame = 0;
    };

    ChunkStore(const ChunkGroups& groups, const ChunkStoreOptions& options);
    void take(const ChunkId& parent, Result<ChunkGroup> group);
    void make_room();

    const ChunkGroups& groups_;
    ChunkStoreOptions options_;
    ChunkId above_root_;
    std::map<ChunkId, Resident> residents_;
    std::uint64_t bytes_ = 0;
    std::uint64_t frame_ = 1;
    Figures figures_;
    std::set<ChunkId> failed_;
    std::optional<Error> failure_;
    BackgroundLoader<ChunkId, ChunkGroup> loader_;  // last: its threads use the rest
};

}  // namespace relevo::lod
