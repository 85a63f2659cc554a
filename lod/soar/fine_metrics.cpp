#include "lod/soar/fine_metrics.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "lod/scene/metric_code.hpp"

namespace relevo::lod {

namespace {

GridPoint moved(const GridPoint& p, const GridPoint& by) {
    return {p.column + by.column, p.row + by.row};
}

}  // namespace

void FineMetrics::begin(const MetricTile& tile, int levels, int half_size_limit, ObjectErrors errors) {
    tile_ = &tile;
    levels_ = levels;
    coarse_ = std::min(2 * half_size_limit, 1 << levels);
    with_bounded_ = errors == ObjectErrors::both;
    const BlockGrid::Box& window = tile.window();
    built_end_.assign(static_cast<std::size_t>(2 * levels), window.row);
    for (auto* values : {&bounded_, &incremental_, &radius_}) {
        values->resize(tile.samples());
        // Beyond the window there are no vertices.
        std::fill_n(values->begin(), tile.row_begin(window.row), 0.0f);
        std::fill(values->begin() + tile.row_begin(window.row - 1), values->end(), 0.0f);
    }
}

void FineMetrics::build_placed() {
    const int window_end = tile_->window().row + tile_->window().rows;
    const bool all = tile_->placed_end() == window_end;
    int children_end = tile_->placed_end();
    for (int level = 2 * levels_ - 1; level >= 0 && 2 * half_size(levels_, level) <= coarse_; --level) {
        const int s = half_size(levels_, level);
        const int to_children = level % 2 == 0 ? s : std::max(s / 2, 1);
        const int end = all ? window_end : std::min(tile_->placed_end() - s, children_end - to_children);
        int& row = built_end_[static_cast<std::size_t>(level)];
        for (; row < end; ++row) build_row(row, level, s);
        children_end = row;
    }
}

void FineMetrics::build_row(int row, int level, int s) {
    if (row % s != 0) return;
    const bool odd_row = (row / s) % 2 == 1;
    if (level % 2 == 0 && !odd_row) return;
    for (int c = level % 2 == 1 && odd_row ? 0 : s; c < MetricTile::kClasses; c += 2 * s)
        build_lanes({tile_->first_column() + c, row}, level, s);
}

/// One class of vertices in a row.
void FineMetrics::build_lanes(const GridPoint& first, int level, int s) {
    const DiamondShape shape = diamond_shape(first, level, s);
    if (level % 2 == 1 && s == 1) return finish_last_level_lanes(first, shape);
    const MetricTile& tile = *tile_;
    const int lanes = tile.lanes();
    const auto posts = [&](const GridPoint& by) { return tile.at(tile.index(moved(first, by))); };
    const Lanes here = posts({0, 0});
    const Lanes left = posts(shape.left);
    const Lanes right = posts(shape.right);

    std::array<std::ptrdiff_t, 4> child;
    std::array<Lanes, 4> children;
    for (std::size_t i = 0; i < 4; ++i) {
        child[i] = tile.index(moved(first, shape.children[i]));
        children[i] = tile.at(child[i]);
    }
    const auto of_children = [&child](const std::vector<float>& values) {
        std::array<const float*, 4> result;
        for (std::size_t i = 0; i < 4; ++i) result[i] = values.data() + child[i];
        return result;
    };
    const std::ptrdiff_t i = tile.index(first);
    const double* hole = tile.holes(i);
    float* radius = radius_.data() + i;
    if (tile.all_valid()) {
        nest_radius(here, children, of_children(radius_), nullptr, lanes, radius);
    } else {
        const std::array<Lanes, 4> corners{left, right, posts(shape.apexes[0]), posts(shape.apexes[1])};
        nest_radius(here, children, of_children(radius_), &corners, lanes, radius);
    }

    std::array<double, kMostLanes> m2;
    surplus2(here, left, right, hole, lanes, m2.data());
    nest_error(m2.data(), of_children(incremental_), radius, lanes, incremental_.data() + i);
    if (!with_bounded_ || s == 1) return;
    diamond_posts(first, level, s)
        .deviation2(tile.at(0), tile.holes(0), tile.offsets(first, s), lanes, m2.data());
    const bool children_are_finest = s == 2 && level % 2 == 1;
    nest_error(m2.data(), of_children(children_are_finest ? incremental_ : bounded_), radius, lanes,
               bounded_.data() + i);
}

void FineMetrics::finish_last_level_lanes(const GridPoint& first, const DiamondShape& shape) {
    const MetricTile& tile = *tile_;
    const std::array<GridPoint, 4> corner{shape.left, shape.right, shape.apexes[0], shape.apexes[1]};
    const std::ptrdiff_t i = tile.index(first);
    std::array<Lanes, 4> corners;
    std::array<const double*, 5> holes{tile.holes(i)};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::ptrdiff_t at = tile.index(moved(first, corner[k]));
        corners[k] = tile.at(at);
        holes[k + 1] = tile.holes(at);
    }
    finish_last_level(tile.at(i), corners, tile.all_valid() ? nullptr : &holes, tile.lanes(),
                      incremental_.data() + i, radius_.data() + i);
}

MetricRasters FineMetrics::codes(const BlockGrid::Box& box) const {
    using Codes = Raster<std::uint16_t>;
    MetricRasters result{Codes(box.columns, box.rows), Codes(box.columns, box.rows),
                         Codes(box.columns, box.rows)};
    if (with_bounded_) {
        cut(box, bounded_, false, result.bounded);
        cut(box, incremental_, true, result.bounded);
    }
    for (const bool odd : {false, true}) {
        cut(box, incremental_, odd, result.incremental);
        cut(box, radius_, odd, result.radius);
    }
    return result;
}

/// Of the posts at even columns and rows, or of the others.
void FineMetrics::cut(const BlockGrid::Box& box, const std::vector<float>& values, bool of_odd_posts,
                      Raster<std::uint16_t>& into) const {
    const int lanes = tile_->lanes();
    const int lead = box.column - tile_->first_column();
    for (int y = 0; y < box.rows; ++y) {
        const int row = box.row + y;
        if (!of_odd_posts && row % 2 == 1) continue;
        const float* from = values.data() + tile_->row_begin(row);
        std::uint16_t* to = into.row(y);
        const bool all = of_odd_posts && row % 2 == 1;
        for (int c = of_odd_posts && !all ? 1 : 0; c < MetricTile::kClasses; c += all ? 1 : 2) {
            if (row % coarse_ == 0 && c % coarse_ == 0) continue;
            int x = (c - lead) % MetricTile::kClasses;
            if (x < 0) x += MetricTile::kClasses;
            const float* lane = from + c * lanes + (lead + x) / MetricTile::kClasses;
            for (; x < box.columns; x += MetricTile::kClasses, ++lane)
                to[x] = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(*lane) >>
                                                   (23 - kCodeMantissaBits));
        }
    }
}

MetricRasters fine_metrics(const MetricTile& tile, int levels, int half_size, ObjectErrors errors) {
    FineMetrics metrics;
    if (!tile.any_valid()) {
        using Codes = Raster<std::uint16_t>;
        const BlockGrid::Box& box = tile.window();
        return {Codes(box.columns, box.rows), Codes(box.columns, box.rows), Codes(box.columns, box.rows)};
    }
    metrics.begin(tile, levels, half_size, errors);
    metrics.build_placed();
    return metrics.codes(tile.window());
}

}  // namespace relevo::lod
