#include "ingest/posts/outliers.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <tuple>

namespace relevo::ingest {
namespace {

constexpr float kSpared = 100;  // metres
constexpr float kSparedMads = 12;
constexpr int kFewest = 9;
constexpr int kMostPosts = 25;

/// The lower one of the two in the middle, so that it is a height of the data.
float median(std::span<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

bool before(const Outlier& a, const Outlier& b) {
    const float stands_out_a = std::abs(a.height - a.median);
    const float stands_out_b = std::abs(b.height - b.median);
    return std::tuple(-stands_out_a, a.row, a.column) < std::tuple(-stands_out_b, b.row, b.column);
}

void keep_largest(std::vector<Outlier>& list) {
    const std::size_t kept = std::min(list.size(), Outliers::kMostListed);
    std::partial_sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(kept), list.end(), before);
    list.resize(kept);
}

/// In the rasters' own places.
std::vector<Outlier> all_outliers(const lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks,
                                  Window inside) {
    assert(heights.columns() == marks.columns() && heights.rows() == marks.rows());
    std::vector<Outlier> all;
    for (int r = inside.row; r < inside.row + inside.rows; ++r) {
        for (int c = inside.column; c < inside.column + inside.columns; ++c) {
            if (const auto middle = outlier_median(heights, marks, c, r))
                all.push_back({c, r, heights.at(c, r), *middle});
        }
    }
    return all;
}

Outliers listed(std::vector<Outlier> all, Window inside, int column, int row) {
    for (Outlier& outlier : all) {
        outlier.column += column - inside.column;
        outlier.row += row - inside.row;
    }
    Outliers found{all.size(), std::move(all)};
    keep_largest(found.largest);
    return found;
}

}  // namespace

void Outliers::add(const Outliers& part) {
    count += part.count;
    largest.insert(largest.end(), part.largest.begin(), part.largest.end());
    keep_largest(largest);
}

std::optional<float> outlier_median(const lod::Raster<float>& heights,
                                    const lod::Raster<lod::PostMark>& marks, int column, int row) {
    if (marks.at(column, row).is_void()) return {};
    const float here = heights.at(column, row);
    std::array<float, kMostPosts> values{};
    std::size_t count = 0;
    int near = 0;
    for (int r = std::max(row - 2, 0); r <= std::min(row + 2, heights.rows() - 1); ++r) {
        for (int c = std::max(column - 2, 0); c <= std::min(column + 2, heights.columns() - 1); ++c) {
            if (marks.at(c, r).is_void()) continue;
            values[count++] = heights.at(c, r);
            // Most of the window near it, and so the median too: nearly every post ends here.
            if (std::abs(heights.at(c, r) - here) <= kSpared && ++near > kMostPosts / 2) return {};
        }
    }
    if (count < kFewest) return {};
    const std::span<float> window{values.data(), count};
    const float middle = median(window);
    if (!(std::abs(here - middle) > kSpared)) return {};
    for (float& value : window) value = std::abs(value - middle);
    const float spread = median(window);
    if (std::abs(here - middle) > kSpared + kSparedMads * spread) return middle;
    return {};
}

Outliers find_outliers(const lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks,
                       Window inside, int column, int row) {
    return listed(all_outliers(heights, marks, inside), inside, column, row);
}

Outliers despike(lod::Raster<float>& heights, lod::Raster<lod::PostMark>& marks, Window inside, int column,
                 int row) {
    std::vector<Outlier> all = all_outliers(heights, marks, inside);
    for (const Outlier& outlier : all) {
        heights.at(outlier.column, outlier.row) = outlier.median;
        marks.at(outlier.column, outlier.row).set_filled();
    }
    return listed(std::move(all), inside, column, row);
}

}  // namespace relevo::ingest
