#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "lod/lstr/chunk_index.hpp"
#include "lod/lstr/chunk_ranges.hpp"
#include "lod/lstr/chunk_splits.hpp"
#include "lod/lstr/chunk_store.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Which nodes are drawn, and which are kept in memory for the pictures to come.
struct SelectionOptions {
    /// The swap sphere: nodes are in memory out to so many times the distance at which they are drawn...
    double swap_factor = 1.2;
    /// ...and no farther than this. Where that is less than they are drawn at, the ground is coarse beyond.
    double swap_radius_m = std::numeric_limits<double>::infinity();
    double fade_s = 0.3;  ///< in which late nodes come in; 0: at once
    bool front_to_back = true;
};

struct SelectedChunk {
    ChunkId id;
    const PlacedChunk* chunk = nullptr;
    /// How much of their way to the coarser level its vertices have moved, 0 to 1: inside, and on the sides,
    /// where the node across finds the same. All of it where the node across is a coarser one.
    double moved = 0;
    std::array<double, kSides> moved_on_side{};
    /// The children of the node across, where these are drawn: they are finer.
    std::array<const ChunkGroup*, kSides> finer{};
    double distance_m = 0;
};

/// Finds the nodes that a view shows, of those that are there: where a finer node is missing, or its
/// neighbours are, the coarser one stands for it, so that neighbours stay at most a level apart whatever is
/// missing.
class ChunkSelector {
  public:
    ChunkSelector(const ChunkSet& chunks, const geo::GridFrame& frame);

    /// What a view wants, and what is in its swap sphere.
    const std::vector<ChunkWish>& wish(const View& view, const RefineOptions& refine,
                                       const SelectionOptions& options);

    /// Of the view that was wished for last. What is selected points into the store.
    const std::vector<SelectedChunk>& select(const View& view, const RefineOptions& refine,
                                             const SelectionOptions& options, const ChunkStore& store);

    /// Are nodes still coming in?
    bool is_fading() const { return !fades_.empty(); }

  private:
    using Clock = std::chrono::steady_clock;

    /// What the frame under way knows of a node.
    enum class State : std::uint8_t { none, drawn, split };

    State state(const ChunkId& id) const { return index_.has(id) ? states_[index_.place(id)] : State::none; }
    bool may_split(const ChunkId& id) const;
    double fade_of(const ChunkId& parent) const;
    void pass_time(double fade_s);
    void finish(SelectedChunk& chunk, const ChunkStore& store) const;

    const ChunkSet& chunks_;
    geo::GridFrame frame_;
    ChunkIndex index_;
    ChunkRanges ranges_;
    ChunkSplits splits_;
    std::vector<ChunkWish> wishes_;
    std::vector<State> states_;
    std::vector<std::size_t> touched_;
    std::vector<SelectedChunk> selected_;
    std::set<ChunkId> forced_;         // drawn in the last picture for want of finer ones
    std::map<ChunkId, double> fades_;  // by the nodes whose children are coming in
    Clock::time_point last_time_;
};

}  // namespace relevo::lod
