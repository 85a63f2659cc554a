#include "lod/lstr/chunk_selector.hpp"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace relevo::lod {

ChunkSelector::ChunkSelector(const ChunkSet& chunks, const geo::GridFrame& frame)
    : chunks_(chunks),
      frame_(frame),
      index_(frame),
      ranges_(chunks, index_),
      splits_(chunks, index_, ranges_),
      states_(index_.size()) {}

const std::vector<ChunkWish>& ChunkSelector::wish(const View& view, const RefineOptions& refine,
                                                  const SelectionOptions& options) {
    ranges_.update(view, refine);
    splits_.update(view, refine, std::max(options.swap_factor, 1.0));
    wishes_.clear();
    wishes_.push_back({index_.root().parent(), true, 0});
    std::set<ChunkId> seen{index_.root().parent()};
    for (const ChunkSplits::Node& node : splits_.nodes()) {
        const double reach = splits_.reach(node.id);
        if (node.distance_m > options.swap_radius_m || reach > options.swap_factor) continue;
        const bool now = reach < 1 && node.distance_m <= refine.view_distance_m &&
                         seen.contains(node.id.parent()) && (!refine.cull || node.box.is_in(view));
        if (now) seen.insert(node.id);
        wishes_.push_back({node.id, now, reach});
    }
    return wishes_;
}

double ChunkSelector::fade_of(const ChunkId& parent) const {
    if (fades_.empty()) return 0;
    const auto found = fades_.find(parent);
    return found == fades_.end() ? 0 : found->second;
}

void ChunkSelector::pass_time(double fade_s) {
    const auto now = Clock::now();
    const double passed = fade_s > 0 ? std::chrono::duration<double>(now - last_time_).count() / fade_s : 1;
    last_time_ = now;
    for (auto& [parent, fade] : fades_) fade -= passed;
    std::erase_if(fades_, [](const auto& entry) { return entry.second <= 0; });
}

/// Not beside a node that is drawn a level coarser, and not while it or its neighbours are coming in.
bool ChunkSelector::may_split(const ChunkId& id) const {
    if (fade_of(id.parent()) > 0) return false;
    for (const Side side : {Side::west, Side::east, Side::north, Side::south}) {
        const ChunkId across = id.beside(side).parent();
        if (state(across) == State::drawn || fade_of(across) > 0) return false;
    }
    return true;
}

const std::vector<SelectedChunk>& ChunkSelector::select(const View& view, const RefineOptions& refine,
                                                        const SelectionOptions& options,
                                                        const ChunkStore& store) {
    pass_time(options.fade_s);
    for (const std::size_t place : touched_) states_[place] = State::none;
    touched_.clear();
    selected_.clear();
    std::set<ChunkId> forced;
    const auto draw = [&](const ChunkId& id, double distance_m) {
        selected_.push_back({id, &store.find(id.parent())->children[id.sibling()], 0, {}, {}, distance_m});
    };
    std::vector<ChunkId> level{index_.root()};
    std::vector<ChunkId> finer;
    // A level at a time: whether a node may be split depends on what the level above it has come to.
    for (; !level.empty(); std::swap(level, finer)) {
        finer.clear();
        for (const ChunkId& id : level) {
            if (id.level == 0) {
                const PlacedChunk& leaf = store.find(id.parent())->children[id.sibling()];
                if (refine.cull && !leaf.is_in(view)) continue;
                const double distance_m = leaf.distance_m(view.eye().m);
                if (distance_m <= refine.view_distance_m) draw(id, distance_m);
                continue;
            }
            const ChunkNode& node = *chunks_.node(id);
            const ChunkBox box = node.box.exaggerated(refine.exaggeration, node.most_H_m);
            if (refine.cull && !box.is_in(view)) continue;
            const double distance_m = box.distance_m(view.eye().m);
            if (distance_m > refine.view_distance_m) continue;
            const bool wanted = splits_.splits(id);
            const bool possible = wanted && store.find(id) != nullptr && may_split(id);
            if (wanted && !possible) forced.insert(id);
            states_[index_.place(id)] = possible ? State::split : State::drawn;
            touched_.push_back(index_.place(id));
            if (!possible) {
                draw(id, distance_m);
                continue;
            }
            if (options.fade_s > 0 && forced_.contains(id)) fades_.emplace(id, 1.0);
            for (int i = 0; i < 4; ++i) {
                if (has_data(id.child(i), frame_)) finer.push_back(id.child(i));
            }
        }
    }
    forced_ = std::move(forced);
    for (SelectedChunk& chunk : selected_) finish(chunk, store);
    if (options.front_to_back) {
        std::sort(selected_.begin(), selected_.end(), [](const SelectedChunk& a, const SelectedChunk& b) {
            return std::pair(a.distance_m, a.id) < std::pair(b.distance_m, b.id);
        });
    }
    return selected_;
}

void ChunkSelector::finish(SelectedChunk& chunk, const ChunkStore& store) const {
    const auto moved_below = [&](const ChunkId& parent) {
        return std::max(splits_.moved(parent), fade_of(parent));
    };
    chunk.moved = moved_below(chunk.id.parent());
    for (const Side side : {Side::west, Side::east, Side::north, Side::south}) {
        const auto i = static_cast<std::size_t>(side);
        const ChunkId across = chunk.id.beside(side);
        const ChunkId coarser = across.parent();
        chunk.moved_on_side[i] = chunk.moved;
        if (state(coarser) == State::drawn) chunk.moved_on_side[i] = 1;
        if (state(coarser) == State::split)
            chunk.moved_on_side[i] = std::max(chunk.moved, moved_below(coarser));
        if (state(across) == State::split) chunk.finer[i] = store.find(across);
    }
}

}  // namespace relevo::lod
