#include "lod/lstr/chunk_ranges.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::lod {

namespace {

/// Of the distance at which a node gives way to its children, where their morph begins at the latest.
constexpr double kMorphFrom = 0.75;
/// And where at the earliest it is over, so that there always is one.
constexpr double kMorphAtMost = 0.95;

}  // namespace

ChunkRanges::ChunkRanges(const ChunkSet& chunks, const ChunkIndex& index)
    : index_(index), ranges_(index.size()) {
    nodes_.reserve(index.size());
    index.for_each([&](const ChunkId& id) { nodes_.push_back(chunks.node(id)); });
}

void ChunkRanges::update(const View& view, const RefineOptions& options) {
    const View::ErrorScale scale = view.error_scale();
    const double px_to_m = scale.lambda_px / options.tau_px + scale.kappa;
    if (px_to_m == px_to_m_ && options.morph == morph_ && options.exaggeration == exaggeration_) return;
    px_to_m_ = px_to_m;
    morph_ = options.morph;
    exaggeration_ = options.exaggeration;
    index_.for_each([&](const ChunkId& id) { update_node(id, px_to_m, options); });
}

/// Finer nodes are up to date.
void ChunkRanges::update_node(const ChunkId& id, double px_to_m, const RefineOptions& options) {
    double finer_m = 0;  // what its children are off, and with their vertices moved
    double moved_m = 0;
    double reach_m = 0;  // from where on the node may have to be split for what is finer, in it and beside it
    for (int row = 2 * id.row - 1; row <= 2 * id.row + 2; ++row) {
        for (int column = 2 * id.column - 1; column <= 2 * id.column + 2; ++column) {
            const ChunkId child{id.level - 1, column, row};
            if (!index_.has(child)) continue;
            const std::size_t place = index_.place(child);
            const ChunkNode& node = *nodes_[place];
            reach_m = std::max(reach_m,
                               ranges_[place].reach_m + node.box.diameter_m() +
                                   2 * std::abs(options.exaggeration - 1) * node.most_H_m * std::sqrt(3.0));
            if (child.parent() != id) continue;
            finer_m = std::max(finer_m, node.error_m);
            moved_m = std::max(moved_m, node.moved_error_m);
        }
    }
    const std::size_t place = index_.place(id);
    const double error_m = std::max({nodes_[place]->error_m, finer_m, options.morph ? moved_m : 0.0});
    // Exaggerated heights are off by as many times as much; the curvature is not exaggerated.
    const double m_to_m = px_to_m * std::max(options.exaggeration, 1.0);
    ChunkRange& range = ranges_[place];
    range.split_m = m_to_m * error_m;
    // In between the error grows in line with the distance, from the finer level's.
    range.morph_from = 1;
    if (options.morph)
        range.morph_from = std::clamp(error_m > 0 ? finer_m / error_m : 0.0, kMorphFrom, kMorphAtMost);
    range.reach_m = std::max(range.split_m, reach_m / (options.morph ? kMorphFrom : 1));
}

}  // namespace relevo::lod
