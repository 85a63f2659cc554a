#include "viewer/ocean/water_pages.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

namespace {

PageSea::Part either(const PageSea::Part& a, const PageSea::Part& b) {
    return {a.sea || b.sea, a.land || b.land};
}

}  // namespace

WaterPages::WaterPages(const geo::GridFrame& frame, int top)
    : frame_(frame), top_(top), states_(index({-1, 0, 0})) {}

std::size_t WaterPages::index(const Page& page) const {
    const std::size_t levels_above = ((std::size_t{1} << (2 * (top_ - page.level))) - 1) / 3;
    return levels_above + (static_cast<std::size_t>(page.row) << (top_ - page.level)) +
           static_cast<std::size_t>(page.column);
}

void WaterPages::fill(const std::vector<Shown>& shown) {
    std::fill(states_.begin(), states_.end(), State{});
    for (const auto& [page, sea] : shown) {
        State& state = states_[index(page)];
        state.own = sea;
        state.below = sea->all;
    }
    for (auto at = shown.rbegin(); at != shown.rend(); ++at) {
        const Page& page = at->page;
        if (page.level == top_) continue;
        Content& parent = states_[index({page.level + 1, page.column / 2, page.row / 2})].below;
        parent = either(parent, states_[index(page)].below);
    }
}

void WaterPages::add(const Rectangle& cells, const Page& page, Content& content) const {
    const State& here = states_[index(page)];
    const double side = static_cast<double>(kPageCells << page.level);
    const double west = page.column * side;
    const double north = page.row * side;
    if (cells.east < west || cells.west > west + side || cells.south < north || cells.north > north + side)
        return;
    const bool news = (here.below.sea && !content.sea) || (here.below.land && !content.land);
    if (!news) return;
    const auto child = [&](int i) {
        return Page{page.level - 1, 2 * page.column + (i & 1), 2 * page.row + (i >> 1)};
    };
    // What of the finer pages is not there is drawn from this one.
    bool whole = page.level > 0;
    for (int i = 0; whole && i < 4; ++i)
        whole = states_[index(child(i))].own != nullptr || !has_data(child(i), frame_);
    if (!whole && here.own != nullptr) {
        const double part = side / PageSea::kParts;
        const auto clamped = [](double at) {
            return std::clamp(static_cast<int>(std::floor(at)), 0, PageSea::kParts - 1);
        };
        for (int row = clamped((cells.north - north) / part); row <= clamped((cells.south - north) / part);
             ++row) {
            for (int column = clamped((cells.west - west) / part);
                 column <= clamped((cells.east - west) / part); ++column)
                content = either(content, here.own->at(column, row));
            if ((content.sea || !here.own->all.sea) && (content.land || !here.own->all.land)) break;
        }
    }
    if (page.level == 0) return;
    for (int i = 0; i < 4; ++i) {
        if (states_[index(child(i))].own != nullptr) add(cells, child(i), content);
    }
}

}  // namespace relevo::viewer
