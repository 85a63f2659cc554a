#include "lod/soar/fine_metrics.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "lod/machine_clones.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/soar/four.hpp"

namespace relevo::lod {

namespace {

GridPoint moved(const GridPoint& p, const GridPoint& by) {
    return {p.column + by.column, p.row + by.row};
}

/// From values of a row's classes to codes by column, by squares of 4 x 4.
[[RELEVO_CLONES("avx2", "default")]] void codes_by_column(const float* const* classes, int lanes,
                                                          std::uint16_t* by_column) {
    typedef std::uint32_t Words __attribute__((vector_size(16), aligned(4), may_alias));
    constexpr int kClasses = MetricTile::kClasses;
    for (int c = 0; c < kClasses; c += 4) {
        for (int k = 0; k < lanes; k += 4) {
            constexpr int dropped = 23 - kCodeMantissaBits;
            const FourWords w0 = *reinterpret_cast<const Words*>(classes[c] + k) >> dropped;
            const FourWords w1 = *reinterpret_cast<const Words*>(classes[c + 1] + k) >> dropped;
            const FourWords w2 = *reinterpret_cast<const Words*>(classes[c + 2] + k) >> dropped;
            const FourWords w3 = *reinterpret_cast<const Words*>(classes[c + 3] + k) >> dropped;
            // Codes have 16 bits: two classes to a word, then two words to a lane.
            const FourWords w01 = w0 | w1 << 16;
            const FourWords w23 = w2 | w3 << 16;
            const FourWords pairs[] = {__builtin_shuffle(w01, w23, FourWords{0, 4, 1, 5}),
                                       __builtin_shuffle(w01, w23, FourWords{2, 6, 3, 7})};
            std::uint16_t* to = by_column + k * kClasses + c;
            for (int i = 0; i < 4; ++i)
                std::memcpy(to + i * kClasses, reinterpret_cast<const char*>(pairs) + 8 * i, 8);
        }
    }
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
    const bool all_valid = tile.all_valid(first.row - s, first.row + s);
    const double* hole = all_valid ? nullptr : tile.holes(i);
    float* radius = radius_.data() + i;
    if (all_valid) {
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
        .deviation2(tile.at(0), all_valid ? nullptr : tile.holes(0), tile.offsets(first, s), lanes,
                    m2.data());
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
    finish_last_level(tile.at(i), corners, tile.all_valid(first.row - 1, first.row + 1) ? nullptr : &holes,
                      tile.lanes(), incremental_.data() + i, radius_.data() + i);
}

MetricRasters FineMetrics::codes(const BlockGrid::Box& box) const {
    using Codes = Raster<std::uint16_t>;
    MetricRasters result{Codes(box.columns, box.rows), Codes(box.columns, box.rows),
                         Codes(box.columns, box.rows)};
    if (with_bounded_) cut(box, bounded_, incremental_, result.bounded);
    cut(box, incremental_, incremental_, result.incremental);
    cut(box, radius_, radius_, result.radius);
    return result;
}

/// \param even  of the posts at even columns and rows, \param odd  of the others
void FineMetrics::cut(const BlockGrid::Box& box, const std::vector<float>& even,
                      const std::vector<float>& odd, Raster<std::uint16_t>& into) const {
    constexpr int kClasses = MetricTile::kClasses;
    const int lanes = tile_->lanes();
    const std::vector<float> none(static_cast<std::size_t>(lanes));
    std::vector<std::uint16_t> by_column(static_cast<std::size_t>(kClasses * lanes));
    std::array<const float*, kClasses> classes;
    for (int y = 0; y < box.rows; ++y) {
        const int row = box.row + y;
        for (int c = 0; c < kClasses; ++c) {
            const bool is_fine = row % coarse_ != 0 || c % coarse_ != 0;
            const std::vector<float>& values = row % 2 == 0 && c % 2 == 0 ? even : odd;
            classes[static_cast<std::size_t>(c)] =
                is_fine ? values.data() + tile_->row_begin(row) + c * lanes : none.data();
        }
        codes_by_column(classes.data(), lanes, by_column.data());
        std::copy_n(by_column.data() + (box.column - tile_->first_column()), box.columns, into.row(y));
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
