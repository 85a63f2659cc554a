#include "lod/lstr/chunk_ranges.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace relevo::lod {

namespace {

/// Of the distance at which a level gives way, where its morph begins at the latest.
constexpr double kMorphFrom = 0.75;
/// And where at the earliest it is over, so that there always is one.
constexpr double kMorphAtMost = 0.95;

}  // namespace

double ChunkRange::moved(double distance_m) const {
    if (distance_m <= morph_from_m) return 0;
    return std::min((distance_m - morph_from_m) / (until_m - morph_from_m), 1.0);
}

ChunkRanges::ChunkRanges(const ChunkSet& chunks, const geo::GridFrame& frame) {
    const int top = top_chunk_level(frame);
    levels_.resize(static_cast<std::size_t>(std::max(top, 0)) + 1);
    for (int k = 1; k <= top; ++k) {
        Level& level = levels_[static_cast<std::size_t>(k)];
        const int cells = ChunkId{k, 0, 0}.cells();
        level.columns = (std::max(frame.columns - 1, 1) + cells - 1) / cells;
        level.rows = (std::max(frame.rows - 1, 1) + cells - 1) / cells;
        for (int row = 0; row < level.rows; ++row) {
            for (int column = 0; column < level.columns; ++column)
                level.nodes.push_back(chunks.node({k, column, row}));
        }
        level.ranges.resize(level.nodes.size());
        level.reach_m.resize(level.nodes.size());
    }
}

void ChunkRanges::update(const View& view, const RefineOptions& options) {
    const View::ErrorScale scale = view.error_scale(options.tau_px);
    const double px_to_m = scale.lambda_px / options.tau_px + scale.kappa;
    if (px_to_m == px_to_m_ && options.morph == morph_ && options.exaggeration == exaggeration_) return;
    px_to_m_ = px_to_m;
    morph_ = options.morph;
    exaggeration_ = options.exaggeration;
    for (std::size_t level = 1; level < levels_.size(); ++level) update_level(level, px_to_m, options);
}

void ChunkRanges::update_level(std::size_t k, double px_to_m, const RefineOptions& options) {
    Level& level = levels_[k];
    const Level& finer = levels_[k - 1];
    // Exaggerated heights are off by as many times as much; the curvature is not exaggerated.
    const double times = std::max(options.exaggeration, 1.0);
    tbb::parallel_for(0, level.rows, [&](int row) {
        for (int column = 0; column < level.columns; ++column) {
            const std::size_t at = level.place(column, row);
            double finer_m = 0;  // what its children are off, and with their vertices moved
            double moved_m = 0;
            double farthest = 0;  // of what is drawn finer, in it and beside it
            for (int r = 2 * row - 1; r <= 2 * row + 2; ++r) {
                for (int c = 2 * column - 1; c <= 2 * column + 2; ++c) {
                    if (!finer.has(c, r)) continue;
                    const std::size_t child = finer.place(c, r);
                    farthest = std::max(farthest, finer.reach_m[child]);
                    if (c >> 1 != column || r >> 1 != row) continue;
                    finer_m = std::max(finer_m, finer.nodes[child]->error_m);
                    moved_m = std::max(moved_m, finer.nodes[child]->moved_error_m);
                }
            }
            const ChunkNode& node = *level.nodes[at];
            const double error_m = std::max({node.error_m, finer_m, options.morph ? moved_m : 0.0});
            ChunkRange& range = level.ranges[at];
            range.until_m =
                std::max(px_to_m * times * error_m, options.morph ? farthest / kMorphFrom : farthest);
            range.morph_from_m = range.until_m;
            if (options.morph) {
                // In between the error grows in line with the distance, from the finer level's.
                range.morph_from_m =
                    std::max(farthest, std::max(kMorphFrom * range.until_m, px_to_m * times * finer_m));
                range.morph_from_m = std::min(range.morph_from_m, kMorphAtMost * range.until_m);
            }
            level.reach_m[at] = range.until_m + node.box.diameter_m() +
                                2 * std::abs(options.exaggeration - 1) * node.most_H_m * std::sqrt(3.0);
        }
    });
}

const ChunkRange& ChunkRanges::below(const ChunkId& parent) const {
    static const ChunkRange endless;
    if (parent.level < 1 || static_cast<std::size_t>(parent.level) >= levels_.size()) return endless;
    const Level& level = levels_[static_cast<std::size_t>(parent.level)];
    return level.ranges[level.place(parent.column, parent.row)];
}

const ChunkRange& ChunkRanges::on_side(const ChunkId& chunk, Side side) const {
    const ChunkRange& own = below(chunk.parent());
    const ChunkId other = chunk.beside(side).parent();
    if (static_cast<std::size_t>(other.level) >= levels_.size() ||
        !levels_[static_cast<std::size_t>(other.level)].has(other.column, other.row))
        return own;
    const ChunkRange& beside = below(other);
    return std::pair(beside.until_m, beside.morph_from_m) < std::pair(own.until_m, own.morph_from_m) ? beside
                                                                                                     : own;
}

}  // namespace relevo::lod
