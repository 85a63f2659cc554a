#pragma once

#include <limits>
#include <vector>

#include "geo/frame.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/soar/refiner.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Distances from the eye for the children of a node, metres.
struct ChunkRange {
    double morph_from_m = std::numeric_limits<double>::infinity();
    double until_m = std::numeric_limits<double>::infinity();  ///< from here on the node stands for them

    /// How much of its way to the coarser level a vertex has moved, 0 to 1.
    double moved(double distance_m) const;
};

/// How near a node's box must be for its children to be drawn instead. Not nearer than where the node's own
/// error is tau pixels; and so far that neighbours in the picture are at most a level apart, and that none
/// moves beside a finer one (docs/lstr.md).
class ChunkRanges {
  public:
    /// The set must outlive this.
    ChunkRanges(const ChunkSet& chunks, const geo::GridFrame& frame);

    /// For a view. Costs nothing while picture, field of view and options stay.
    void update(const View& view, const RefineOptions& options);

    /// Of the node's children. Endless for the one above the root.
    const ChunkRange& below(const ChunkId& parent) const;

    /// For the vertices on a node's side: of the two that share it, the nearer range.
    const ChunkRange& on_side(const ChunkId& chunk, Side side) const;

  private:
    /// The nodes of a level that hold data, row by row.
    struct Level {
        int columns = 0;
        int rows = 0;
        std::vector<const ChunkNode*> nodes;
        std::vector<ChunkRange> ranges;
        std::vector<double> reach_m;  // of a node's children that are drawn: how far all of them is

        bool has(int column, int row) const {
            return column >= 0 && row >= 0 && column < columns && row < rows;
        }
        std::size_t place(int column, int row) const {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column);
        }
    };
    void update_level(std::size_t level, double px_to_m, const RefineOptions& options);

    std::vector<Level> levels_;  // level 0 is empty
    double px_to_m_ = 0;
    bool morph_ = false;
    double exaggeration_ = 0;
};

}  // namespace relevo::lod
