#include "lod/mesh_heights.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace relevo::lod {

namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

/// Mean of the valid samples in [column, column + size) x [row, row + size) of the raster; NaN for none.
float mean(const Raster<float>& samples, int column, int row, int size) {
    double sum = 0;
    int count = 0;
    for (int y = row; y < std::min(row + size, samples.rows()); ++y) {
        for (int x = column; x < std::min(column + size, samples.columns()); ++x) {
            if (const float H = samples.at(x, y); !std::isnan(H)) {
                sum += static_cast<double>(H);
                ++count;
            }
        }
    }
    return count == 0 ? kVoid : static_cast<float>(sum / count);
}

bool is_void(float H) {
    return std::isnan(H);
}

bool any_void(const Raster<float>& heights, int row) {
    const float* H = heights.row(row);
    int count = 0;  // without a way out of the loop it is done by many at once
    for (int i = 0; i < heights.columns(); ++i) count += H[i] == H[i] ? 0 : 1;
    return count > 0;
}

/// Bilinear in a raster of means at fine sample `column`, `row`, of which `size` a side make a mean.
float between_means(const Raster<float>& means, int column, int row, int size) {
    struct Part {
        int near, far;
        float share;  // of far
    };
    const auto part = [size](int fine, int count) {
        const int near = fine / size;
        const float from_middle = (static_cast<float>(fine % size) + 0.5f) / static_cast<float>(size) - 0.5f;
        const int far = std::clamp(near + (from_middle < 0 ? -1 : 1), 0, count - 1);
        return Part{near, far, std::abs(from_middle)};
    };
    const Part x = part(column, means.columns());
    const Part y = part(row, means.rows());
    const auto along = [&](int r) {
        return (1 - x.share) * means.at(x.near, r) + x.share * means.at(x.far, r);
    };
    return (1 - y.share) * along(y.near) + y.share * along(y.far);
}

/// Pull (means of ever larger squares) and push (voids take the interpolated mean of the next coarser level).
/// \pre at least one sample is valid
void fill_voids(Raster<float>& samples) {
    if (std::none_of(samples.samples().begin(), samples.samples().end(), is_void)) return;
    Raster<float> coarse((samples.columns() + 1) / 2, (samples.rows() + 1) / 2);
    for (int row = 0; row < coarse.rows(); ++row) {
        for (int column = 0; column < coarse.columns(); ++column)
            coarse.at(column, row) = mean(samples, 2 * column, 2 * row, 2);
    }
    fill_voids(coarse);
    for (int row = 0; row < samples.rows(); ++row) {
        for (int column = 0; column < samples.columns(); ++column) {
            float& H = samples.at(column, row);
            if (is_void(H)) H = between_means(coarse, column, row, 2);
        }
    }
}

int cells(int posts) {
    return (posts + MeshHeights::kCell - 1) / MeshHeights::kCell;
}

}  // namespace

MeshHeights::MeshHeights(const geo::GridFrame& frame)
    : columns_(frame.columns),
      rows_(frame.rows),
      levels_(frame.levels()),
      means_(cells(columns_), cells(rows_), kVoid),
      lattice_(cells(columns_), cells(rows_), kVoid),
      last_column_(static_cast<std::size_t>(rows_), kVoid),
      last_row_(static_cast<std::size_t>(columns_), kVoid) {}

void MeshHeights::add(int column, int row, const Raster<float>& heights) {
    assert(column % kCell == 0 && row % kCell == 0);
    if (const std::atomic_ref<bool> whole(whole_); whole.load(std::memory_order_relaxed)) {
        const auto has_part = [](float H) { return H != std::trunc(H) && !is_void(H); };
        if (std::ranges::any_of(heights.samples(), has_part)) whole.store(false, std::memory_order_relaxed);
    }
    for (int y = 0; y < heights.rows(); y += kCell) {
        for (int x = 0; x < heights.columns(); x += kCell) {
            means_.at((column + x) / kCell, (row + y) / kCell) = mean(heights, x, y, kCell);
            lattice_.at((column + x) / kCell, (row + y) / kCell) = heights.at(x, y);
        }
    }
    if (column + heights.columns() == columns_) {
        for (int y = 0; y < heights.rows(); ++y)
            last_column_[static_cast<std::size_t>(row + y)] = heights.at(heights.columns() - 1, y);
    }
    if (row + heights.rows() == rows_) {
        std::copy_n(heights.row(heights.rows() - 1), heights.columns(), last_row_.begin() + column);
    }
}

void MeshHeights::finish() {
    if (std::all_of(means_.samples().begin(), means_.samples().end(), is_void)) {
        std::fill(means_.samples().begin(), means_.samples().end(), 0.0f);
    } else {
        fill_voids(means_);
    }
}

float MeshHeights::of_void(int column, int row) const {
    const float H = between_means(means_, column, row, kCell);
    return whole_ ? std::round(H) : H;
}

float MeshHeights::of_padding(int column, int row) const {
    const int c = std::min(column, columns_ - 1);
    const int r = std::min(row, rows_ - 1);
    const float H =
        c < column ? last_column_[static_cast<std::size_t>(r)] : last_row_[static_cast<std::size_t>(c)];
    return is_void(H) ? of_void(c, r) : H;
}

float MeshHeights::fill(int column, int row) const {
    return column < columns_ && row < rows_ ? of_void(column, row) : of_padding(column, row);
}

Raster<float> MeshHeights::filled(const BlockGrid::Box& box, const Raster<float>& heights) const {
    Raster<float> all(box.columns, box.rows, kVoid);
    if (heights.columns() > 0) paste(heights, {}, all);
    if (std::none_of(all.samples().begin(), all.samples().end(), is_void)) return all;
    for (int row = box.row % 2; row < box.rows; row += 2) {
        if (!any_void(all, row)) continue;
        for (int column = box.column % 2; column < box.columns; column += 2) {
            float& H = all.at(column, row);
            if (is_void(H)) H = fill(box.column + column, box.row + row);
        }
    }
    fill_odd_posts({box.column, box.row}, levels_, all);
    for (int row = 0; row < box.rows; ++row) {
        // What is left has an end outside.
        const bool edge_row = row == 0 || row + 1 == box.rows;
        for (int column = 0; column < box.columns; column += edge_row ? 1 : std::max(box.columns - 1, 1)) {
            float& H = all.at(column, row);
            if (is_void(H)) H = fill(box.column + column, box.row + row);
        }
    }
    return all;
}

float MeshHeights::lattice(int column, int row) const {
    if (column >= columns_ || row >= rows_) return of_padding(column, row);
    const float H = lattice_.at(column / kCell, row / kCell);
    return is_void(H) ? of_void(column, row) : H;
}

bool MeshHeights::lattice_is_valid(int column, int row) const {
    return column < columns_ && row < rows_ && !is_void(lattice_.at(column / kCell, row / kCell));
}

void fill_odd_posts(const GridPoint& first, int levels, Raster<float>& heights) {
    const auto at = [&](const GridPoint& p) {
        const int x = p.column - first.column;
        const int y = p.row - first.row;
        const bool inside = x >= 0 && y >= 0 && x < heights.columns() && y < heights.rows();
        return inside ? heights.at(x, y) : kVoid;
    };
    for (int row = 0; row < heights.rows(); ++row) {
        if (!any_void(heights, row)) continue;
        const int y = first.row + row;
        for (int column = 0; column < heights.columns(); ++column) {
            float& H = heights.at(column, row);
            if (!is_void(H)) continue;
            const int x = first.column + column;
            if (x % 2 == 0 && y % 2 == 0) continue;
            const int level = x % 2 != 0 && y % 2 != 0 ? 2 * levels - 2 : 2 * levels - 1;
            const Diamond d = diamond({x, y}, level, levels);
            H = 0.5f * (at(d.left) + at(d.right));
        }
    }
}

Raster<float> mesh_heights(const geo::GridFrame& frame, const Raster<float>& heights) {
    MeshHeights fill(frame);
    fill.add(0, 0, heights);
    fill.finish();
    return fill.filled({0, 0, frame.padded_side(), frame.padded_side()}, heights);
}

}  // namespace relevo::lod
