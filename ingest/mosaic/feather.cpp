#include "ingest/mosaic/feather.hpp"

#include <algorithm>
#include <cmath>

#include "ingest/mosaic/extent_index.hpp"

namespace relevo::ingest {

Feather::Reach Feather::reach(int column, int row) const {
    // The middle of the post's tile, so that it does not depend on the window.
    const auto middle = [](int at, int most) {
        return std::min(at / kTransformTile * kTransformTile + kTransformTile / 2, most - 1);
    };
    const auto spacing = frame_.spacing(
        {static_cast<double>(middle(column, frame_.columns)), static_cast<double>(middle(row, frame_.rows))});
    const auto posts = [&](double step) {
        return static_cast<int>(std::min(std::ceil(width_m_ / step), static_cast<double>(kMostFeatherPosts)));
    };
    return {posts(spacing.column_m), posts(spacing.row_m), spacing.column_m, spacing.row_m};
}

Window Feather::with_halo(Window window) const {
    int columns = 0;
    int rows = 0;
    for (int r = window.row; r < window.row + window.rows; r += kTransformTile)
        for (int c = window.column; c < window.column + window.columns; c += kTransformTile) {
            const Reach here = reach(c, r);
            columns = std::max(columns, here.columns);
            rows = std::max(rows, here.rows);
        }
    return common_part(
        {window.column - columns, window.row - rows, window.columns + 2 * columns, window.rows + 2 * rows},
        {0, 0, frame_.columns, frame_.rows});
}

lod::Raster<float> Feather::weights(const lod::Raster<float>& finer, const lod::Raster<float>& under,
                                    Window halo, Window window) const {
    // Rows to the nearest post of the column where only the lower one has a height; then, along a row, the
    // nearest of these (Felzenszwalb and Huttenlocher's two passes, the second one by looking at all columns
    // in reach).
    constexpr int kNone = 1 << 20;
    lod::Raster<int> rows_away{halo.columns, halo.rows, kNone};
    const auto only_under = [&](int c, int r) {
        return std::isnan(finer.at(c, r)) && !std::isnan(under.at(c, r));
    };
    for (int c = 0; c < halo.columns; ++c) {
        for (int r = 0, away = kNone; r < halo.rows; ++r) {
            away = only_under(c, r) ? 0 : std::min(away + 1, kNone);
            rows_away.at(c, r) = away;
        }
        for (int r = halo.rows - 1, away = kNone; r >= 0; --r) {
            away = only_under(c, r) ? 0 : std::min(away + 1, kNone);
            rows_away.at(c, r) = std::min(rows_away.at(c, r), away);
        }
    }
    lod::Raster<float> weights{window.columns, window.rows, 1.0F};
    Reach here;
    for (int r = 0; r < window.rows; ++r)
        for (int c = 0; c < window.columns; ++c) {
            if (c == 0 || (window.column + c) % kTransformTile == 0)
                here = reach(window.column + c, window.row + r);
            const int column = window.column + c - halo.column;
            const int row = window.row + r - halo.row;
            double nearest = width_m_ * width_m_;
            for (int k = std::max(column - here.columns, 0);
                 k <= std::min(column + here.columns, halo.columns - 1); ++k) {
                const int away = rows_away.at(k, row);
                if (away > here.rows) continue;
                const double x = (k - column) * here.column_m;
                const double y = away * here.row_m;
                nearest = std::min(nearest, x * x + y * y);
            }
            weights.at(c, r) = static_cast<float>(std::sqrt(nearest) / width_m_);
        }
    return weights;
}

}  // namespace relevo::ingest
