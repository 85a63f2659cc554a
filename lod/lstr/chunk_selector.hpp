#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "lod/lstr/chunk_ranges.hpp"
#include "lod/lstr/chunk_store.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Which nodes are drawn, and which are kept in memory for the pictures to come.
struct SelectionOptions {
    /// The swap sphere: nodes are in memory out to so many times the distance at which they are drawn...
    double swap_factor = 1.2;
    /// ...or, if it is not 0, to this one, of all levels. Smaller than it need be, the ground is coarse
    /// beyond.
    double swap_radius_m = 0;
    double view_distance_m = std::numeric_limits<double>::infinity();  ///< farther nodes are not drawn
    double fade_s = 0.3;  ///< in which late nodes come in; 0: at once
    bool front_to_back = true;
};

/// How far a node's vertices have moved to the coarser level.
struct ChunkMotion {
    const ChunkRange* range = nullptr;
    double fade = 0;  ///< at least so far: 1 just come in, 0 there

    double moved(double distance_m) const { return std::max(range->moved(distance_m), fade); }
    friend bool operator==(const ChunkMotion&, const ChunkMotion&) = default;
};

struct SelectedChunk {
    ChunkId id;
    const PlacedChunk* chunk = nullptr;
    ChunkMotion inside;
    std::array<ChunkMotion, kSides> on_side;
    std::array<bool, kSides> closes{};  ///< what is across the side is coarser
    double distance_m = 0;
};

/// Finds the nodes that a view shows, of those that are there: where a finer node is missing, or its
/// neighbours are, the coarser one stands for it, so that neighbours stay at most a level apart whatever is
/// missing.
class ChunkSelector {
  public:
    ChunkSelector(const ChunkSet& chunks, const geo::GridFrame& frame);

    /// What is selected points into the store and the ranges.
    const std::vector<SelectedChunk>& select(const View& view, const RefineOptions& refine,
                                             const SelectionOptions& options, const ChunkRanges& ranges,
                                             const ChunkStore& store);

    /// What the last view draws with, or would, and what is in its swap sphere.
    std::vector<ChunkWish> wishes(const View& view, const RefineOptions& refine,
                                  const SelectionOptions& options, const ChunkRanges& ranges) const;

    /// Are nodes still coming in?
    bool is_fading() const { return !fades_.empty(); }

  private:
    using Clock = std::chrono::steady_clock;

    /// What the frame under way knows of a node.
    enum class State : std::uint8_t { none, drawn, split };
    struct Level {
        int columns = 0;
        int rows = 0;
        std::vector<State> states;
    };

    State& state(const ChunkId& id);
    State state_of(const ChunkId& id) const;
    bool may_split(const ChunkId& id) const;
    double fade_of(const ChunkId& parent) const;
    void finish(SelectedChunk& chunk, const ChunkRanges& ranges) const;

    const ChunkSet& chunks_;
    geo::GridFrame frame_;
    ChunkId root_;
    std::vector<Level> levels_;
    std::vector<ChunkId> touched_;
    std::vector<SelectedChunk> selected_;
    std::set<ChunkId> forced_;         // drawn in the last picture for want of finer ones
    std::map<ChunkId, double> fades_;  // by the nodes whose children are coming in
    Clock::time_point last_time_;
};

}  // namespace relevo::lod
