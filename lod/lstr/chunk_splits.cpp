#include "lod/lstr/chunk_splits.hpp"

#include <algorithm>

namespace relevo::lod {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

ChunkSplits::ChunkSplits(const ChunkSet& chunks, const ChunkIndex& index, const ChunkRanges& ranges)
    : chunks_(chunks), index_(index), ranges_(ranges), reach_(index.size(), kNever) {}

void ChunkSplits::update(const View& view, const RefineOptions& options, double reach_factor) {
    for (const Node& node : nodes_) reach_[node.place] = kNever;
    nodes_.clear();
    morph_ = options.morph;
    const auto look_at = [&](const ChunkId& id) {
        if (!index_.has(id)) return;
        const std::size_t place = index_.place(id);
        const ChunkNode& known = *chunks_.node(id);
        Node node{id, place, known.box.exaggerated(options.exaggeration, known.most_H_m), 0};
        node.distance_m = node.box.distance_m(view.eye().m);
        const ChunkRange& range = ranges_[place];
        if (node.distance_m > reach_factor * range.reach_m) return;
        reach_[place] = range.split_m > 0 ? node.distance_m / range.split_m : kNever;
        nodes_.push_back(node);
    };
    look_at(index_.root());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const ChunkId id = nodes_[i].id;
        for (int child = 0; child < 4; ++child) look_at(id.child(child));
    }
    // Level by level, the finest first: what is finer than the root reaches it in one pass.
    std::for_each(nodes_.rbegin(), nodes_.rend(), [&](const Node& node) { spread(node); });
}

/// Before a node is split the coarser ones around it are, and their children have come to rest.
void ChunkSplits::spread(const Node& node) {
    const double reach = reach_[node.place];
    if (reach == kNever) return;
    const auto to = [&](const ChunkId& coarser) {
        if (!index_.has(coarser)) return;
        const std::size_t place = index_.place(coarser);
        reach_[place] = std::min(reach_[place], ranges_[place].morph_from * reach);
    };
    to(node.id.parent());
    to(node.id.beside((node.id.column & 1) == 0 ? Side::west : Side::east).parent());
    to(node.id.beside((node.id.row & 1) == 0 ? Side::north : Side::south).parent());
}

double ChunkSplits::moved(const ChunkId& id) const {
    const double reach = this->reach(id);
    if (!morph_ || reach == kNever) return morph_ ? 1 : 0;
    const double from = ranges_[index_.place(id)].morph_from;
    return std::clamp((reach - from) / (1 - from), 0.0, 1.0);
}

}  // namespace relevo::lod
