#include "lod/static_mesh/ground_cells.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "lod/static_mesh/post_rows.hpp"

namespace relevo::lod {
namespace {

template <class CountRow>
std::uint64_t count_rows(int rows, const CountRow& count_row) {
    return tbb::parallel_reduce(
        tbb::blocked_range<int>(0, rows, 16), std::uint64_t{0},
        [&](const tbb::blocked_range<int>& some, std::uint64_t count) {
            for (int row = some.begin(); row < some.end(); ++row) count += count_row(row);
            return count;
        },
        std::plus<>{});
}

}  // namespace

GroundCells::GroundCells(const Raster<float>& heights)
    : columns_(std::max(heights.columns() - 1, 0)),
      rows_(std::max(heights.rows() - 1, 0)),
      no_ground_(std::max(columns_, 1), std::max(rows_, 1)) {
    count_ = count_rows(rows_, [&](int row) {
        const float* north = heights.row(row);
        const float* south = heights.row(row + 1);
        std::uint64_t ground = 0;
        for (int column = 0; column < columns_; ++column) {
            // NaN if one of them is: the sum of finite heights is none.
            const double sum = static_cast<double>(north[column]) + static_cast<double>(north[column + 1]) +
                               static_cast<double>(south[column]) + static_cast<double>(south[column + 1]);
            if (std::isnan(sum)) {
                no_ground_.add({column, row});
            } else {
                ++ground;
            }
        }
        return ground;
    });
    all_ = count_ == static_cast<std::uint64_t>(columns_) * static_cast<std::uint64_t>(rows_);
    covered_posts_ = all_ ? (count_ == 0 ? 0
                                         : static_cast<std::uint64_t>(heights.columns()) *
                                               static_cast<std::uint64_t>(heights.rows()))
                          : count_rows(heights.rows(), [&](int row) {
                                std::uint64_t covered = 0;
                                for (int column = 0; column <= columns_; ++column)
                                    covered += is_ground(column, row) || is_ground(column - 1, row) ||
                                               is_ground(column, row - 1) || is_ground(column - 1, row - 1);
                                return covered;
                            });
}

bool GroundCells::is_ground(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
    return all_ || !no_ground_.contains({column, row});
}

GroundCells::Share GroundCells::share(const BisectionTriangle& triangle) const {
    if (all_) return Share::all;
    bool ground = false;
    bool other = false;
    bool begun = false;
    int above_first = 0;
    int above_last = 0;
    for_each_row({triangle.left, triangle.right, triangle.apex}, [&](int row, int first, int last) {
        // Cells between two rows of posts that the triangle reaches into: from the westernmost of its posts
        // in both to the easternmost.
        const int west = std::min(first, above_first);
        const int east = std::min(std::max(last, above_last), columns_) - 1;
        if (begun && west <= east) {
            const PostSet::Share none = no_ground_.share(row - 1, west, east);
            other = other || none.any;
            ground = ground || !none.all;
        }
        begun = true;
        above_first = first;
        above_last = last;
        return row < rows_ && !(ground && other);
    });
    if (ground && other) return Share::some;
    return ground ? Share::all : Share::none;
}

}  // namespace relevo::lod
