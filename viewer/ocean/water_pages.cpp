#include "viewer/ocean/water_pages.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

namespace {

PageSea::Content either(const PageSea::Content& a, const PageSea::Content& b) {
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
        state.below = sea->all();
    }
    for (auto at = shown.rbegin(); at != shown.rend(); ++at) {
        const Page& page = at->page;
        if (page.level == top_) continue;
        Content& parent = states_[index({page.level + 1, page.column / 2, page.row / 2})].below;
        parent = either(parent, states_[index(page)].below);
    }
}

WaterPages::Rectangle WaterPages::cells_of(const Page& page) {
    const double side = static_cast<double>(kPageCells << page.level);
    const double west = page.column * side;
    const double north = page.row * side;
    return {west, north, west + side, north + side};
}

void WaterPages::add_own(const Rectangle& cells, const Page& page, Content& content) const {
    const State& here = states_[index(page)];
    if (here.own == nullptr) return;
    const Rectangle whole = cells_of(page);
    const double apart = static_cast<double>(1 << page.level);
    const auto before = [&](double at) {
        return std::clamp(static_cast<int>(std::floor(at / apart)), 0, kPageCells);
    };
    const auto after = [&](double at) {
        return std::clamp(static_cast<int>(std::ceil(at / apart)), 0, kPageCells);
    };
    content = either(content, here.own->in(before(cells.west - whole.west), before(cells.north - whole.north),
                                           after(cells.east - whole.west), after(cells.south - whole.north)));
}

void WaterPages::add(const Rectangle& cells, const Page& page, Content& content) const {
    const Content& below = states_[index(page)].below;
    const bool news = (below.sea && !content.sea) || (below.land && !content.land);
    if (!news) return;
    if (page.level == 0) return add_own(cells, page, content);
    for (int i = 0; i < 4; ++i) {
        const Page child{page.level - 1, 2 * page.column + (i & 1), 2 * page.row + (i >> 1)};
        const Rectangle quarter = cells_of(child);
        const Rectangle asked{std::max(cells.west, quarter.west), std::max(cells.north, quarter.north),
                              std::min(cells.east, quarter.east), std::min(cells.south, quarter.south)};
        if (asked.west > asked.east || asked.north > asked.south || !has_data(child, frame_)) continue;
        if (states_[index(child)].own != nullptr)
            add(asked, child, content);
        else
            add_own(asked, page, content);
    }
}

}  // namespace relevo::viewer
