#include "viewer/bench/open_sea.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "viewer/ground/page.hpp"

namespace relevo::viewer {

namespace {

constexpr int kLeastCells = 16;

/// Cells of a page along an axis that has so many posts.
int data_cells(int posts, int level, int page, int side) {
    return std::min(((posts - 1) >> level) - page * kPageCells, side);
}

struct Square {
    int cells = 0;
    double off = INFINITY;  ///< from the data's middle, posts
    geo::GridPosition middle;
};

/// Improves on `best` with squares of a page's posts, which is_open(column, row) tells about.
template <class IsOpen>
void find_square(const Page& page, const geo::GridFrame& frame, int columns, int rows, const IsOpen& is_open,
                 Square& best) {
    for (int cells = kPageCells; cells >= std::max(kLeastCells, best.cells); cells /= 2) {
        for (int row = 0; row + cells <= rows; row += cells) {
            for (int column = 0; column + cells <= columns; column += cells) {
                const double scale = std::ldexp(1.0, page.level);
                const geo::GridPosition middle{scale * (page.column * kPageCells + column + 0.5 * cells),
                                               scale * (page.row * kPageCells + row + 0.5 * cells)};
                const double off = std::hypot(middle.column - 0.5 * (frame.columns - 1),
                                              middle.row - 0.5 * (frame.rows - 1));
                if (cells == best.cells && off >= best.off) continue;
                bool open = true;
                for (int y = row; open && y <= row + cells; ++y) {
                    for (int x = column; open && x <= column + cells; ++x) open = is_open(x, y);
                }
                if (open) best = {cells, off, middle};
            }
        }
    }
}

}  // namespace

Result<std::optional<geo::LatLon>> open_sea(const lod::Pyramid& pyramid, double bed_m) {
    const geo::GridFrame& frame = pyramid.frame();
    std::vector<Page> pages{{pyramid.top(), 0, 0}};
    while (!pages.empty()) {
        Square deep, any;
        std::vector<Page> finer;
        for (const Page& page : pages) {
            const auto posts = pyramid.read_ground(page);
            if (!posts) return posts.error();
            const auto& sea = posts->is_sea;
            const int columns = data_cells(frame.columns, page.level, page.column, sea.columns() - 1);
            const int rows = data_cells(frame.rows, page.level, page.row, sea.rows() - 1);
            find_square(
                page, frame, columns, rows,
                [&](int column, int row) {
                    return sea.at(column, row) != 0 &&
                           static_cast<double>(posts->heights.at(column, row)) < bed_m;
                },
                deep);
            find_square(
                page, frame, columns, rows, [&](int column, int row) { return sea.at(column, row) != 0; },
                any);
            const auto& samples = sea.samples();
            if (page.level == 0 ||
                std::count(samples.begin(), samples.end(), 0) == static_cast<std::ptrdiff_t>(samples.size()))
                continue;
            for (int i = 0; i < 4; ++i) {
                const Page child{page.level - 1, 2 * page.column + (i & 1), 2 * page.row + (i >> 1)};
                if (has_data(child, frame)) finer.push_back(child);
            }
        }
        const Square& best = deep.cells > 0 ? deep : any;
        if (best.cells > 0) return std::optional(frame.lat_lon(best.middle));
        pages = std::move(finer);
    }
    return std::optional<geo::LatLon>();
}

bool OffShore::at(geo::LatLon place) {
    constexpr double kFar = 64;
    const geo::GridFrame& frame = pyramid_.frame();
    const geo::GridPosition at = frame.grid_position(place);
    const auto page = [](double position, int posts) {
        return static_cast<int>(std::clamp(position, 0.0, std::max(posts - 2.0, 0.0))) / kPageCells;
    };
    for (int row = page(at.row - kFar, frame.rows); row <= page(at.row + kFar, frame.rows); ++row) {
        for (int column = page(at.column - kFar, frame.columns);
             column <= page(at.column + kFar, frame.columns); ++column) {
            if (!is_sea(column, row)) return false;
        }
    }
    return true;
}

bool OffShore::is_sea(int column, int row) {
    const auto [found, made] = pages_.try_emplace({column, row}, false);
    if (!made) return found->second;
    const auto posts = pyramid_.read_ground({0, column, row});
    if (!posts) return false;
    const geo::GridFrame& frame = pyramid_.frame();
    const int columns = data_cells(frame.columns, 0, column, posts->is_sea.columns() - 1);
    const int rows = data_cells(frame.rows, 0, row, posts->is_sea.rows() - 1);
    bool sea = true;
    for (int y = 0; sea && y <= rows; ++y) {
        for (int x = 0; sea && x <= columns; ++x) sea = posts->is_sea.at(x, y) != 0;
    }
    return found->second = sea;
}

}  // namespace relevo::viewer
