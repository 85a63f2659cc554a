#include "lod/lstr/chunk_selector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace relevo::lod {

ChunkSelector::ChunkSelector(const ChunkSet& chunks, const geo::GridFrame& frame)
    : chunks_(chunks), frame_(frame), root_{std::max(top_chunk_level(frame), 0), 0, 0} {
    for (int k = 0; k <= root_.level; ++k) {
        const int cells = ChunkId{k, 0, 0}.cells();
        const auto across = [&](int posts) { return (std::max(posts - 1, 1) + cells - 1) / cells; };
        Level level{across(frame.columns), across(frame.rows), {}};
        level.states.resize(static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows));
        levels_.push_back(std::move(level));
    }
}

ChunkSelector::State& ChunkSelector::state(const ChunkId& id) {
    Level& level = levels_[static_cast<std::size_t>(id.level)];
    return level.states[static_cast<std::size_t>(id.row) * static_cast<std::size_t>(level.columns) +
                        static_cast<std::size_t>(id.column)];
}

ChunkSelector::State ChunkSelector::state_of(const ChunkId& id) const {
    if (static_cast<std::size_t>(id.level) >= levels_.size()) return State::none;
    const Level& level = levels_[static_cast<std::size_t>(id.level)];
    if (id.column < 0 || id.row < 0 || id.column >= level.columns || id.row >= level.rows) return State::none;
    return level.states[static_cast<std::size_t>(id.row) * static_cast<std::size_t>(level.columns) +
                        static_cast<std::size_t>(id.column)];
}

double ChunkSelector::fade_of(const ChunkId& parent) const {
    if (fades_.empty()) return 0;
    const auto found = fades_.find(parent);
    return found == fades_.end() ? 0 : found->second;
}

/// Not beside a node that is drawn a level coarser, and not while it or its neighbours are coming in.
bool ChunkSelector::may_split(const ChunkId& id) const {
    if (fade_of(id.parent()) > 0) return false;
    for (const Side side : {Side::west, Side::east, Side::north, Side::south}) {
        const ChunkId across = id.beside(side);
        if (across.column < 0 || across.row < 0) continue;
        if (state_of(across.parent()) == State::drawn || fade_of(across.parent()) > 0) return false;
    }
    return true;
}

const std::vector<SelectedChunk>& ChunkSelector::select(const View& view, const RefineOptions& refine,
                                                        const SelectionOptions& options,
                                                        const ChunkRanges& ranges, const ChunkStore& store) {
    const auto now = Clock::now();
    const double passed =
        options.fade_s > 0 ? std::chrono::duration<double>(now - last_time_).count() / options.fade_s : 1;
    last_time_ = now;
    for (auto& [parent, fade] : fades_) fade -= passed;
    std::erase_if(fades_, [](const auto& entry) { return entry.second <= 0; });

    for (const ChunkId& id : touched_) state(id) = State::none;
    touched_.clear();
    selected_.clear();
    std::set<ChunkId> forced;
    const auto draw = [&](const ChunkId& id, double distance_m) {
        const ChunkGroup& group = *store.find(id.parent());
        const auto place = static_cast<std::size_t>((id.column & 1) + 2 * (id.row & 1));
        state(id) = State::drawn;
        selected_.push_back({id, &group.children[place], {}, {}, {}, distance_m});
    };
    std::vector<ChunkId> level{root_};
    std::vector<ChunkId> finer;
    // A level at a time: whether a node may be split depends on what the level above it has come to.
    for (; !level.empty(); std::swap(level, finer)) {
        finer.clear();
        for (const ChunkId& id : level) {
            touched_.push_back(id);
            if (id.level == 0) {
                const ChunkGroup& group = *store.find(id.parent());
                const PlacedChunk& leaf =
                    group.children[static_cast<std::size_t>((id.column & 1) + 2 * (id.row & 1))];
                if (refine.cull && !leaf.is_in(view)) continue;
                const double distance_m =
                    std::max(glm::distance(leaf.middle, view.eye().m) - leaf.radius_m, 0.0);
                if (distance_m <= options.view_distance_m) draw(id, distance_m);
                continue;
            }
            const ChunkNode& node = *chunks_.node(id);
            const ChunkBox box = node.box.exaggerated(refine.exaggeration, node.most_H_m);
            if (refine.cull && !box.is_in(view)) continue;
            const double distance_m = box.distance_m(view.eye().m);
            if (distance_m > options.view_distance_m) continue;
            if (distance_m > ranges.below(id).until_m) {
                draw(id, distance_m);
                continue;
            }
            if (store.find(id) == nullptr || !may_split(id)) {
                forced.insert(id);
                draw(id, distance_m);
                continue;
            }
            if (options.fade_s > 0 && forced_.contains(id)) fades_.emplace(id, 1.0);
            state(id) = State::split;
            for (int i = 0; i < 4; ++i) {
                if (has_data(id.child(i), frame_)) finer.push_back(id.child(i));
            }
        }
    }
    forced_ = std::move(forced);
    for (SelectedChunk& chunk : selected_) finish(chunk, ranges);
    if (options.front_to_back) {
        std::sort(selected_.begin(), selected_.end(), [](const SelectedChunk& a, const SelectedChunk& b) {
            return std::pair(a.distance_m, a.id) < std::pair(b.distance_m, b.id);
        });
    }
    return selected_;
}

void ChunkSelector::finish(SelectedChunk& chunk, const ChunkRanges& ranges) const {
    const ChunkId parent = chunk.id.parent();
    chunk.inside = {&ranges.below(parent), fade_of(parent)};
    for (const Side side : {Side::west, Side::east, Side::north, Side::south}) {
        const auto i = static_cast<std::size_t>(side);
        const ChunkId across = chunk.id.beside(side);
        const bool inside = across.column >= 0 && across.row >= 0;
        chunk.closes[i] = inside && state_of(across.parent()) == State::drawn;
        // Both nodes at a side must find the same.
        chunk.on_side[i] = {
            &ranges.on_side(chunk.id, side),
            inside ? std::max(chunk.inside.fade, fade_of(across.parent())) : chunk.inside.fade};
    }
}

std::vector<ChunkWish> ChunkSelector::wishes(const View& view, const RefineOptions& refine,
                                             const SelectionOptions& options,
                                             const ChunkRanges& ranges) const {
    std::vector<ChunkWish> found;
    const auto visit = [&](const auto& self, const ChunkId& id, bool seen) -> void {
        const ChunkNode& node = *chunks_.node(id);
        const ChunkBox box = node.box.exaggerated(refine.exaggeration, node.most_H_m);
        const double distance_m = box.distance_m(view.eye().m);
        const double until_m = ranges.below(id).until_m;
        const double swap_m =
            options.swap_radius_m > 0 ? options.swap_radius_m : options.swap_factor * until_m;
        if (distance_m > swap_m) return;
        seen = seen && distance_m <= std::min(until_m, options.view_distance_m) &&
               (!refine.cull || box.is_in(view));
        found.push_back({id, seen, distance_m / std::max(until_m, 1e-9)});
        if (id.level == 1) return;
        for (int i = 0; i < 4; ++i) {
            if (has_data(id.child(i), frame_)) self(self, id.child(i), seen);
        }
    };
    found.push_back({root_.parent(), true, 0});
    if (root_.level > 0) visit(visit, root_, true);
    return found;
}

}  // namespace relevo::lod
