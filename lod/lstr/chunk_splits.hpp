#pragma once

#include <limits>
#include <vector>

#include "lod/lstr/chunk_index.hpp"
#include "lod/lstr/chunk_ranges.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/soar/refiner.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Which nodes a view splits: those that are nearer than their own error allows, and those beside finer ones,
/// so that neighbours are at most a level apart and none moves beside a finer one (docs/lstr.md). In all
/// directions, whatever the picture shows: turning the head changes nothing.
class ChunkSplits {
  public:
    /// All must outlive this.
    ChunkSplits(const ChunkSet& chunks, const ChunkIndex& index, const ChunkRanges& ranges);

    /// \param reach_factor  nodes are looked at out to so many times the distance from which they could be
    /// split
    void update(const View& view, const RefineOptions& options, double reach_factor);

    struct Node {
        ChunkId id;
        std::size_t place = 0;  ///< in the index
        ChunkBox box;
        double distance_m = 0;
    };
    /// Those that were looked at; a parent comes before its children.
    const std::vector<Node>& nodes() const { return nodes_; }

    /// The node's distance over that from which on it need not be split; infinite where it was not looked at.
    double reach(const ChunkId& id) const {
        return index_.has(id) ? reach_[index_.place(id)] : std::numeric_limits<double>::infinity();
    }
    bool splits(const ChunkId& id) const { return reach(id) < 1; }

    /// How much of their way to the node's own mesh its children's vertices have moved, 0 to 1.
    double moved(const ChunkId& id) const;

  private:
    void spread(const Node& node);

    const ChunkSet& chunks_;
    const ChunkIndex& index_;
    const ChunkRanges& ranges_;
    bool morph_ = true;
    std::vector<Node> nodes_;
    std::vector<double> reach_;
};

}  // namespace relevo::lod
