#include "viewer/ocean/water_pages.hpp"

#include <algorithm>

namespace relevo::viewer {

WaterPages::WaterPages(const geo::GridFrame& frame, int top)
    : frame_(frame), top_(top), states_(index({-1, 0, 0})) {}

std::size_t WaterPages::index(const Page& page) const {
    const std::size_t levels_above = ((std::size_t{1} << (2 * (top_ - page.level))) - 1) / 3;
    return levels_above + (static_cast<std::size_t>(page.row) << (top_ - page.level)) +
           static_cast<std::size_t>(page.column);
}

void WaterPages::fill(const std::vector<Shown>& shown) {
    std::fill(states_.begin(), states_.end(), State{});
    for (const auto& [page, sea, land] : shown) states_[index(page)] = {true, {sea, land}, {sea, land}};
    for (auto at = shown.rbegin(); at != shown.rend(); ++at) {
        const Page& page = at->page;
        if (page.level == top_) continue;
        const Content& here = states_[index(page)].below;
        Content& parent = states_[index({page.level + 1, page.column / 2, page.row / 2})].below;
        parent = {parent.sea || here.sea, parent.land || here.land};
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
    bool whole = page.level > 0;
    for (int i = 0; whole && i < 4; ++i)
        whole = states_[index(child(i))].shown || !has_data(child(i), frame_);
    if (!whole) {
        // What of the finer pages is not there is drawn from this one.
        content = {content.sea || here.below.sea, content.land || here.below.land};
        return;
    }
    for (int i = 0; i < 4; ++i) add(cells, child(i), content);
}

}  // namespace relevo::viewer
