#pragma once

#include <vector>

#include "lod/lstr/chunk_index.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/soar/refiner.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// How near a node must be for its children to be drawn instead.
struct ChunkRange {
    /// From here on the node's own error is within tau. Nearer, its children are drawn.
    double split_m = 0;
    /// The part of this distance at which its children begin to move to where it is; 1: they do not.
    double morph_from = 1;
    /// Beyond, the node stands for its children whatever is beside it.
    double reach_m = 0;
};

/// The ranges of all nodes, for views of one picture size and field of view.
class ChunkRanges {
  public:
    /// The set must outlive this.
    ChunkRanges(const ChunkSet& chunks, const ChunkIndex& index);

    /// For a view. Costs nothing while picture, field of view and options stay.
    void update(const View& view, const RefineOptions& options);

    /// \param place  in the index
    const ChunkRange& operator[](std::size_t place) const { return ranges_[place]; }

  private:
    void update_node(const ChunkId& id, double px_to_m, const RefineOptions& options);

    const ChunkIndex& index_;
    std::vector<const ChunkNode*> nodes_;
    std::vector<ChunkRange> ranges_;
    double px_to_m_ = 0;
    bool morph_ = false;
    double exaggeration_ = 0;
};

}  // namespace relevo::lod
