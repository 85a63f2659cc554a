#include "lod/soar/metric_tile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "lod/machine_clones.hpp"
#include "lod/soar/four.hpp"

namespace relevo::lod {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// How many posts of a row have a height.
int valid_in(const float* heights, int count) {
    int valid = 0;
    for (int i = 0; i < count; ++i) valid += heights[i] == heights[i] ? 1 : 0;
    return valid;
}

[[RELEVO_CLONES("avx2", "default")]] void widen(const float* from, int count, double* to) {
    for (int i = 0; i < count; ++i) to[i] = static_cast<double>(from[i]);
}

/// From columns to classes, by squares of 4 x 4.
[[RELEVO_CLONES("avx2", "default")]] void deal(const double* by_column, int lanes, double* by_class) {
    using Order = FourWhole;
    constexpr int kClasses = MetricTile::kClasses;
    for (int c = 0; c < kClasses; c += 4) {
        for (int k = 0; k < lanes; k += 4) {
            const auto* from = by_column + k * kClasses + c;
            const Four a = *reinterpret_cast<const FourDoubles*>(from);
            const Four b = *reinterpret_cast<const FourDoubles*>(from + kClasses);
            const Four d = *reinterpret_cast<const FourDoubles*>(from + 2 * kClasses);
            const Four e = *reinterpret_cast<const FourDoubles*>(from + 3 * kClasses);
            const Four ab02 = __builtin_shuffle(a, b, Order{0, 4, 2, 6});
            const Four ab13 = __builtin_shuffle(a, b, Order{1, 5, 3, 7});
            const Four de02 = __builtin_shuffle(d, e, Order{0, 4, 2, 6});
            const Four de13 = __builtin_shuffle(d, e, Order{1, 5, 3, 7});
            const Four of_class[] = {__builtin_shuffle(ab02, de02, Order{0, 1, 4, 5}),
                                     __builtin_shuffle(ab13, de13, Order{0, 1, 4, 5}),
                                     __builtin_shuffle(ab02, de02, Order{2, 3, 6, 7}),
                                     __builtin_shuffle(ab13, de13, Order{2, 3, 6, 7})};
            for (int i = 0; i < 4; ++i)
                *reinterpret_cast<FourDoubles*>(by_class + (c + i) * lanes + k) = of_class[i];
        }
    }
}

[[RELEVO_CLONES("avx2", "default")]] void place_geographic(const geo::PostPositions::Row& row,
                                                           const double* cos_lon, const double* sin_lon,
                                                           const double* height, int count, double* x,
                                                           double* y, double* z) {
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
        const double from_axis = row.from_axis + height[i] * row.cos_lat;
        x[i] = from_axis * cos_lon[i];
        y[i] = from_axis * sin_lon[i];
        z[i] = row.z + height[i] * row.sin_lat;
    }
}

}  // namespace

BlockGrid::Box MetricTile::window_of(const Box& tile, int padded_side, int halo) {
    const int left = std::max(tile.column - halo, 0);
    const int top = std::max(tile.row - halo, 0);
    const int right = std::min(tile.column + tile.columns + halo, padded_side);
    const int bottom = std::min(tile.row + tile.rows + halo, padded_side);
    return {left, top, right - left, bottom - top};
}

void MetricTile::count_valid(const Box& window, const Raster<float>& heights) {
    any_valid_ = false;
    rows_with_holes_.assign(1, 0);
    for (int row = 0; row < window.rows; ++row) {
        const int valid = row < heights.rows() ? valid_in(heights.row(row), heights.columns()) : 0;
        any_valid_ = any_valid_ || valid > 0;
        rows_with_holes_.push_back(rows_with_holes_.back() + (valid == window.columns ? 0 : 1));
    }
    all_valid_ = rows_with_holes_.back() == 0;
}

bool MetricTile::all_valid(int first_row, int last_row) const {
    const auto before = [&](int row) {
        return rows_with_holes_[static_cast<std::size_t>(std::clamp(row - window_.row, 0, window_.rows))];
    };
    return before(first_row) == before(last_row + 1);
}

void MetricTile::begin(const MeshGround& ground, const Box& window, const Raster<float>& heights) {
    count_valid(window, heights);
    if (any_valid_ && !all_valid_) own_filled_ = ground.fill.filled(window, heights);
    begin_counted(ground.positions, ground.undulations, window, heights, all_valid_ ? heights : own_filled_);
}

void MetricTile::begin(const geo::PostPositions& positions, const UndulationGrid& undulations,
                       const Box& window, const Raster<float>& heights, const Raster<float>& filled) {
    count_valid(window, heights);
    begin_counted(positions, undulations, window, heights, filled);
}

void MetricTile::begin_counted(const geo::PostPositions& positions, const UndulationGrid& undulations,
                               const Box& window, const Raster<float>& heights, const Raster<float>& filled) {
    assert(window.columns <= kMostColumns);
    window_ = window;
    placed_end_ = window.row;
    positions_ = &positions;
    undulations_ = &undulations;
    heights_ = &heights;
    filled_ = &filled;
    // Lanes begin at a multiple of the classes that leaves room for the reach of diamonds.
    constexpr int reach = DiamondPosts::kReach;
    first_column_ = (window.column - reach + kClasses) / kClasses * kClasses - kClasses;
    const int columns = window.column + window.columns + reach - first_column_;
    lanes_ = (columns + 4 * kClasses - 1) / (4 * kClasses) * 4;

    const auto stride = static_cast<std::size_t>(row_samples());
    const std::size_t count =
        stride * static_cast<std::size_t>(window.rows + 1) + 2 * static_cast<std::size_t>(kSlack);
    for (auto* values : {&x_, &y_, &z_}) values->resize(count);
    for (auto* values : {&height_, &by_class_, &cos_lon_, &sin_lon_}) values->resize(stride);

    if (!any_valid_) return;
    if (!all_valid_) hole_.resize(count);

    if (!positions_->polar()) {
        const auto table = [&](double geo::PostPositions::Column::*value, std::vector<double>& into) {
            std::fill(height_.begin(), height_.end(), kNothing);
            for (int i = 0; i < window.columns; ++i)
                height_[static_cast<std::size_t>(window.column - first_column_ + i)] =
                    positions_->column(window.column + i).*value;
            deal(height_.data(), lanes_, into.data());
        };
        table(&geo::PostPositions::Column::cos_lon, cos_lon_);
        table(&geo::PostPositions::Column::sin_lon, sin_lon_);
    }
    std::fill(height_.begin(), height_.end(), kNothing);

    // The row that stands for all beyond the window, and the slack.
    const std::ptrdiff_t beyond = row_begin(window.row - 1);
    for (auto* values : {&x_, &y_, &z_, &hole_}) {
        if (values == &hole_ && all_valid_) continue;
        std::fill_n(values->begin(), kSlack, kNothing);
        std::fill(values->begin() + beyond, values->end(), kNothing);
    }
}

void MetricTile::place_until(int end) {
    for (; any_valid_ && placed_end_ < end; ++placed_end_) place_row(placed_end_);
}

void MetricTile::place_row(int row) {
    const int first = window_.column - first_column_;
    const float* H = filled_->row(row - window_.row);
    double* h = height_.data() + first;
    widen(H, window_.columns, h);
    undulations_->add_row(window_.column, row, window_.columns, h);
    deal(height_.data(), lanes_, by_class_.data());
    place_lanes(row);
    if (all_valid_) return;

    // In place of the heights, which are placed.
    const int y = row - window_.row;
    std::fill_n(h, window_.columns, kNothing);
    if (y < heights_->rows()) {
        // 0 or NaN.
        widen(heights_->row(y), heights_->columns(), h);
        for (int i = 0; i < heights_->columns(); ++i) h[i] *= 0;
    }
    deal(height_.data(), lanes_, hole_.data() + row_begin(row));
}

void MetricTile::place_lanes(int row) {
    const auto begin = static_cast<std::size_t>(row_begin(row));
    if (const geo::PolarPositions* polar = positions_->polar()) {
        for (int c = 0; c < kClasses; ++c) {
            for (int k = 0; k < lanes_; ++k) {
                const auto i = static_cast<std::size_t>(c * lanes_ + k);
                const glm::dvec3 p = polar->at(first_column_ + k * kClasses + c, row, by_class_[i]);
                x_[begin + i] = p.x;
                y_[begin + i] = p.y;
                z_[begin + i] = p.z;
            }
        }
        return;
    }
    place_geographic(positions_->row(row), cos_lon_.data(), sin_lon_.data(), by_class_.data(),
                     static_cast<int>(row_samples()), &x_[begin], &y_[begin], &z_[begin]);
}

}  // namespace relevo::lod
