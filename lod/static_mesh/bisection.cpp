#include "lod/static_mesh/bisection.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "lod/static_mesh/post_rows.hpp"
#include "lod/static_mesh/surface.hpp"

namespace relevo::lod {

BisectionRoots::BisectionRoots(int columns, int rows) {
    assert(columns >= 2 && rows >= 2);
    const auto shorter = static_cast<unsigned>(std::min(columns, rows) - 1);
    side_ = static_cast<int>(std::max(std::bit_ceil(shorter), 2U));
    across_ = (columns - 2) / side_ + 1;
    down_ = (rows - 2) / side_ + 1;
}

std::vector<BisectionTriangle> BisectionRoots::triangles() const {
    std::vector<BisectionTriangle> all;
    const int half = side_ / 2;
    for (int y = 0; y < down_; ++y) {
        for (int x = 0; x < across_; ++x) {
            const Sides halves = sides({x * side_ + half, y * side_ + half});
            all.insert(all.end(), halves.begin(), halves.end());
        }
    }
    return all;
}

BisectionRoots::Sides BisectionRoots::sides(const GridPoint& split) const {
    // The largest power of two in a coordinate: of both, half the size of the square that has the post as its
    // centre, or on one of its sides as the middle.
    const int size_x = split.column == 0 ? 2 * side_ : split.column & -split.column;
    const int size_y = split.row == 0 ? 2 * side_ : split.row & -split.row;
    const int s = std::min(size_x, size_y);
    Sides both;
    if (s >= side_) return both;
    const auto add = [&](const GridPoint& left, const GridPoint& right, const GridPoint& apex) {
        if (apex.column < 0 || apex.row < 0 || apex.column >= columns() || apex.row >= rows()) return;
        both.triangles[static_cast<std::size_t>(both.count++)] = {left, right, apex};
    };
    if (size_x == size_y) {
        // One end of the diagonal is a corner of the next coarser squares.
        const auto coarse_end = [s](int centre) {
            return (centre - s) % (4 * s) == 0 ? centre - s : centre + s;
        };
        const GridPoint left{coarse_end(split.column), coarse_end(split.row)};
        const GridPoint right{2 * split.column - left.column, 2 * split.row - left.row};
        add(left, right, {left.column, right.row});
        add(left, right, {right.column, left.row});
        return both;
    }
    const bool along_row = size_y > size_x;
    const int dx = along_row ? s : 0;
    const int dy = along_row ? 0 : s;
    const GridPoint left{split.column - dx, split.row - dy};
    const GridPoint right{split.column + dx, split.row + dy};
    for (const int sign : {-1, 1}) add(left, right, {split.column + sign * dy, split.row + sign * dx});
    return both;
}

namespace {

/// Triangles are small that lie in a square of this many cells a side, the grid of which is aligned with the
/// bisection. One thread refines a square, and leaves what that splits in others for later: to follow it
/// there would lead over the whole grid, and pile up triangles that wait for their turn.
constexpr int kSquare = 128;

bool is_small(const BisectionTriangle& t) {
    return std::max(std::abs(t.left.column - t.right.column), std::abs(t.left.row - t.right.row)) <= kSquare;
}

/// The square that a small triangle lies in.
GridPoint square_of(const BisectionTriangle& t) {
    return {std::min({t.left.column, t.right.column, t.apex.column}) / kSquare,
            std::min({t.left.row, t.right.row, t.apex.row}) / kSquare};
}

template <class Surface>
class Chooser {
  public:
    Chooser(const BisectionRoots& roots, const Surface& surface, const GroundCells& cells, double max_error_m)
        : roots_(roots),
          surface_(surface),
          cells_(cells),
          max_error_m_(max_error_m),
          columns_(surface.heights().columns()),
          rows_(surface.heights().rows()),
          splits_(roots.columns(), roots.rows()) {}

    PostSet run() && {
        std::vector<BisectionTriangle> open = roots_.triangles();
        std::vector<BisectionTriangle> now;
        // The latest first, and not all at once: what waits stays short.
        constexpr std::size_t kAtOnce = 8192;
        while (!open.empty()) {
            const std::size_t rest = open.size() - std::min(open.size(), kAtOnce);
            now.assign(open.begin() + static_cast<std::ptrdiff_t>(rest), open.end());
            open.resize(rest);
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, now.size(), 1),
                              [&](const tbb::blocked_range<std::size_t>& some) {
                                  Stacks& stacks = stacks_.local();
                                  for (std::size_t i = some.begin(); i < some.end(); ++i)
                                      refine(now[i], stacks);
                              });
            for (Stacks& stacks : stacks_) {
                open.insert(open.end(), stacks.later.begin(), stacks.later.end());
                stacks.later.clear();
            }
        }
        return std::move(splits_);
    }

  private:
    struct Stacks {
        std::vector<BisectionTriangle> later;  // for another round, any thread
        std::vector<BisectionTriangle> here;   // of one square
        GridPoint square;
        std::vector<GridPoint> splits;
    };

    void refine(const BisectionTriangle& first, Stacks& stacks) {
        stacks.square = is_small(first) ? square_of(first) : GridPoint{-1, -1};
        examine(first, stacks);
        while (!stacks.here.empty()) {
            const BisectionTriangle t = stacks.here.back();
            stacks.here.pop_back();
            examine(t, stacks);
        }
    }

    void examine(const BisectionTriangle& t, Stacks& stacks) {
        if (t.is_finest() || splits_.contains(t.middle()) || !fails(t)) return;
        split(t.middle(), stacks);
    }

    bool is_inside(const GridPoint& p) const { return p.column < columns_ && p.row < rows_; }

    bool meets_grid(const BisectionTriangle& t) const {
        return (is_inside(t.left) && is_inside(t.right) && is_inside(t.apex)) ||
               inner_part(t, columns_, rows_).count > 0;
    }

    /// Splits the edge that a post is the middle of, with the edges that have to be split before it.
    void split(const GridPoint& post, Stacks& stacks) {
        stacks.splits.push_back(post);
        while (!stacks.splits.empty()) {
            const GridPoint p = stacks.splits.back();
            stacks.splits.pop_back();
            const BisectionRoots::Sides sides = roots_.sides(p);
            if (sides.count == 0 || !splits_.add(p)) continue;
            for (const BisectionTriangle& side : sides) {
                if (!meets_grid(side)) continue;
                // The triangle on that side is there only if the one that its apex splits is.
                if (!splits_.contains(side.apex)) stacks.splits.push_back(side.apex);
                for (const BisectionTriangle& half : {side.left_half(), side.right_half()}) {
                    if (half.is_finest()) continue;
                    const bool here = is_small(half) && square_of(half) == stacks.square;
                    (here ? stacks.here : stacks.later).push_back(half);
                }
            }
        }
    }

    bool fails(const BisectionTriangle& t) const {
        switch (cells_.share(t)) {
            case GroundCells::Share::none:
                return false;
            case GroundCells::Share::some:
                return true;
            case GroundCells::Share::all:
                break;
        }
        const bool whole = is_inside(t.left) && is_inside(t.right) && is_inside(t.apex);
        // Most that fail do so here. Of the smallest the middle is the only post that is no corner.
        if (whole) {
            if (surface_.middle_error(t.left, t.right, t.middle()) > max_error_m_) return true;
            if (std::abs(turn(t.left, t.right, t.apex)) == 2) return false;
        }
        for (const PostTriangle& part : inner_part(t, columns_, rows_)) {
            if (exceeds(part)) return true;
        }
        return false;
    }

    bool exceeds(const PostTriangle& part) const {
        const typename Surface::Plane plane(surface_, part);
        constexpr std::int64_t kLarge = std::int64_t{1} << 21;  // posts, times two
        if (turn(part[0], part[1], part[2]) < kLarge) {
            return !for_each_row(part, [&](int row, int first, int last) {
                return !plane.exceeds(row, first, last, max_error_m_);
            });
        }
        // Few triangles are so large, and flat ground would keep all threads but one waiting for each.
        struct Row {
            int row, first, last;
        };
        std::vector<Row> all;
        for_each_row(part, [&](int row, int first, int last) {
            all.push_back({row, first, last});
            return true;
        });
        std::atomic<bool> found = false;
        const auto look = [&](const tbb::blocked_range<std::size_t>& some) {
            for (std::size_t i = some.begin(); i < some.end() && !found; ++i) {
                if (plane.exceeds(all[i].row, all[i].first, all[i].last, max_error_m_)) found = true;
            }
        };
        // Isolated: a thread that waits must not begin another triangle with this one's stacks.
        tbb::this_task_arena::isolate(
            [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.size(), 16), look); });
        return found;
    }

    const BisectionRoots& roots_;
    const Surface& surface_;
    const GroundCells& cells_;
    double max_error_m_;
    int columns_;
    int rows_;
    PostSet splits_;
    tbb::enumerable_thread_specific<Stacks> stacks_;
};

}  // namespace

template <class Surface>
PostSet choose_splits(const BisectionRoots& roots, const Surface& surface, const GroundCells& cells,
                      double max_error_m) {
    return Chooser<Surface>(roots, surface, cells, max_error_m).run();
}

template PostSet choose_splits(const BisectionRoots&, const HeightSurface&, const GroundCells&, double);
template PostSet choose_splits(const BisectionRoots&, const SpaceSurface&, const GroundCells&, double);

}  // namespace relevo::lod
