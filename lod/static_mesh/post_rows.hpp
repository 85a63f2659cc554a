#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "lod/static_mesh/grid_triangle.hpp"

namespace relevo::lod {

/// An edge of a triangle as its column in each row.
class RowEdge {
  public:
    RowEdge(const GridPoint& from, const GridPoint& to)
        : from_(from), run_(to.column - from.column), rise_(to.row - from.row) {
        if (run_ == 0 || run_ == rise_ || run_ == -rise_) slope_ = run_ == 0 ? 0 : run_ == rise_ ? 1 : -1;
    }

    /// The first post at or east of the edge. \pre the edge reaches the row, and is not along it
    int first(int row) const { return slope_ != kUneven ? even(row) : from_.column - divide(-1, row); }
    /// The last post at or west of the edge.
    int last(int row) const { return slope_ != kUneven ? even(row) : from_.column + divide(1, row); }

  private:
    static constexpr int kUneven = 2;

    int even(int row) const { return from_.column + slope_ * (row - from_.row); }
    /// sign * run * rows / rise, rounded down.
    int divide(int sign, int row) const {
        const std::int64_t product = std::int64_t{sign * run_} * (row - from_.row);
        const std::int64_t quotient = product / rise_;
        return static_cast<int>(quotient - (product % rise_ < 0 ? 1 : 0));
    }

    GridPoint from_;
    int run_;
    int rise_;  // at least 0
    int slope_ = kUneven;
};

/// Calls visit(row, first, last) for each row of the posts inside a triangle or on its edges, from the north,
/// until it returns false. \return  whether all rows were visited
template <class Visit>
bool for_each_row(const PostTriangle& triangle, Visit visit) {
    PostTriangle p = triangle;
    const auto north = [](const GridPoint& a, const GridPoint& b) { return a.row < b.row; };
    if (north(p[1], p[0])) std::swap(p[0], p[1]);
    if (north(p[2], p[1])) std::swap(p[1], p[2]);
    if (north(p[1], p[0])) std::swap(p[0], p[1]);
    const bool bends_east = turn(p[0], p[2], p[1]) > 0;
    const RowEdge whole(p[0], p[2]);
    const RowEdge upper(p[0], p[1]);
    const RowEdge lower(p[1], p[2]);
    for (int row = p[0].row; row <= p[2].row; ++row) {
        int first = 0;
        int last = 0;
        const bool at_bend = row == p[1].row;
        const RowEdge& part = row < p[1].row ? upper : lower;
        if (bends_east) {
            first = whole.first(row);
            last = at_bend ? p[1].column : part.last(row);
        } else {
            first = at_bend ? p[1].column : part.first(row);
            last = whole.last(row);
        }
        if (first <= last && !visit(row, first, last)) return false;
    }
    return true;
}

}  // namespace relevo::lod
