#pragma once

#include <cstddef>
#include <vector>

#include "viewer/ground/page_sea.hpp"

namespace relevo::viewer {

/// Where there is sea, as coarsely as the pages that a picture is drawn from tell: what they have no sea in,
/// the picture shows none in.
class WaterPages {
  public:
    WaterPages(const geo::GridFrame& frame, int top);

    /// A page that is drawn from.
    struct Shown {
        Page page;
        const PageSea* sea;  ///< must outlive the next `in`
    };
    /// \param shown  parents before their children
    void fill(const std::vector<Shown>& shown);

    /// Cells of the grid, borders included.
    struct Rectangle {
        double west, north, east, south;
    };
    /// Is any sea there, any land? Cells count with their corners.
    using Content = PageSea::Content;
    Content in(const Rectangle& cells) const {
        Content content;
        add(cells, Page{top_, 0, 0}, content);
        return content;
    }

  private:
    struct State {
        const PageSea* own = nullptr;  // of the page itself; null: it is not there
        Content below;                 // of it and of all pages below it that are shown
    };
    static Rectangle cells_of(const Page& page);
    /// What the page and the finer ones that stand for parts of it have there; of the page alone.
    void add(const Rectangle& cells, const Page& page, Content& content) const;
    void add_own(const Rectangle& cells, const Page& page, Content& content) const;
    std::size_t index(const Page& page) const;

    geo::GridFrame frame_;
    int top_;
    std::vector<State> states_;  // of each page of each level, the top's first
};

}  // namespace relevo::viewer
