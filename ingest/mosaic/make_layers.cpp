// Grouping: which sources become one layer, in which order layers count, and how they come to WGS 84.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "ingest/mosaic/lattice.hpp"
#include "ingest/mosaic/layer.hpp"
#include "ingest/mosaic/longitudes.hpp"
#include "ingest/reference/vertical_datum.hpp"
#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

/// A lattice and the sources on it.
struct Group {
    Affine lattice;
    std::vector<Layer::Member> members;
};

/// The smallest and the largest x of a raster's posts.
LonReach reach_of(const Affine& posts, int columns, int rows) {
    const double corners[] = {posts.at({0, 0}).x, posts.at({columns - 1.0, 0}).x, posts.at({0, rows - 1.0}).x,
                              posts.at({columns - 1.0, rows - 1.0}).x};
    return {*std::min_element(std::begin(corners), std::end(corners)),
            *std::max_element(std::begin(corners), std::end(corners))};
}

/// Posts of all sources; those in longitudes moved by whole turns so that neighbours across a turn's end are
/// neighbours in their CRS as well. Where no turn is needed nothing is touched.
std::vector<Affine> continuous_posts(const SourcePool& pool) {
    std::vector<Affine> posts;
    std::map<const Crs*, std::vector<int>> geographic;
    for (int i = 0; i < pool.count(); ++i) {
        posts.push_back(pool.facts(i).posts);
        if (pool.facts(i).crs->geographic()) geographic[pool.facts(i).crs.get()].push_back(i);
    }
    for (const auto& [crs, sources] : geographic) {
        const double turn = crs->full_turn();
        std::vector<LonReach> reaches;
        for (const int i : sources)
            reaches.push_back(reach_of(pool.facts(i).posts, pool.facts(i).columns, pool.facts(i).rows));
        const double start = start_after_largest_gap(reaches, turn);
        // Relative to the first source as it is, so that it (and with it a single one) stays untouched.
        const double first = reaches[0].west;
        const double base = start + turn * std::floor((first - start) / turn + 1e-9);
        for (std::size_t k = 0; k < sources.size(); ++k) {
            const double turns = std::floor((reaches[k].west - base) / turn + 1e-9);
            if (turns != 0) posts[static_cast<std::size_t>(sources[k])].x0 -= turns * turn;
        }
    }
    return posts;
}

std::vector<Group> grouped(const SourcePool& pool, bool in_order) {
    const auto posts = continuous_posts(pool);
    std::vector<Group> groups;
    for (int i = 0; i < pool.count(); ++i) {
        const SourceFacts& facts = pool.facts(i);
        const Affine& own = posts[static_cast<std::size_t>(i)];
        std::optional<Window> window;
        std::size_t g = in_order && !groups.empty() ? groups.size() - 1 : 0;
        for (; g < groups.size() && !window; ++g) {
            const SourceFacts& first = pool.facts(groups[g].members[0].source);
            if (first.crs != facts.crs || !same_datum(first.heights.reference, facts.heights.reference))
                continue;
            window = window_in(groups[g].lattice, own, facts.columns, facts.rows);
            if (window) groups[g].members.push_back({i, *window});
        }
        if (!window) groups.push_back({own, {{i, {0, 0, facts.columns, facts.rows}}}});
    }
    return groups;
}

/// Places of a group in its CRS: corners, middles of sides and middle of each source, more of few sources.
std::vector<Place> places_of(const Group& group) {
    const int count = group.members.size() < 8 ? 8 : 2;
    std::vector<Place> places;
    for (const auto& member : group.members)
        for (int j = 0; j <= count; ++j)
            for (int i = 0; i <= count; ++i)
                places.push_back(
                    group.lattice.at({member.window.column + (member.window.columns - 1.0) * i / count,
                                      member.window.row + (member.window.rows - 1.0) * j / count}));
    return places;
}

/// One operation for all sources of a CRS, as far as it is defined at all their places: where neighbouring
/// tiles took different ones there would be a step between them.
class Operations {
  public:
    Result<std::shared_ptr<const Operation>> find(const std::shared_ptr<const Crs>& crs,
                                                  const std::vector<Place>& places) {
        for (const auto& known : by_crs_[crs.get()]) {
            auto there = places;
            known->forward(there);
            if (std::none_of(there.begin(), there.end(), [](Place p) { return std::isnan(p.x); }))
                return known;
        }
        auto chosen = Operation::to_wgs84(*crs, places);
        if (!chosen) return chosen.error();
        by_crs_[crs.get()].push_back(std::make_shared<const Operation>(std::move(*chosen)));
        return by_crs_[crs.get()].back();
    }

  private:
    std::map<const Crs*, std::vector<std::shared_ptr<const Operation>>> by_crs_;
};

void sort_finest_first(std::vector<Layer>& layers) {
    std::stable_sort(layers.begin(), layers.end(),
                     [](const Layer& a, const Layer& b) { return a.spacing_m() < b.spacing_m(); });
    const auto first_source = [](const Layer& layer) { return layer.members()[0].source; };
    for (auto from = layers.begin(); from != layers.end();) {
        const double limit = 1.02 * from->spacing_m();
        const auto to =
            std::find_if(from, layers.end(), [&](const Layer& l) { return !(l.spacing_m() <= limit); });
        std::sort(from, to,
                  [&](const Layer& a, const Layer& b) { return first_source(a) < first_source(b); });
        from = to;
    }
}

}  // namespace

Result<std::vector<Layer>> make_layers(const SourcePool& pool, bool in_order) {
    std::vector<Layer> layers;
    Operations operations;
    for (Group& group : grouped(pool, in_order)) {
        const SourceFacts& first = pool.facts(group.members[0].source);
        auto operation = operations.find(first.crs, places_of(group));
        if (!operation)
            return operation.error().kind == ErrorKind::input
                       ? refusal(first.name, operation.error().message, "")
                       : operation.error();
        layers.emplace_back(pool, group.lattice, std::move(group.members), std::move(*operation));
    }
    if (!in_order) sort_finest_first(layers);
    return layers;
}

}  // namespace relevo::ingest
