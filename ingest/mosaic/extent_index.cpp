#include "ingest/mosaic/extent_index.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace relevo::ingest {

Window common_part(Window a, Window b) {
    const int left = std::max(a.column, b.column);
    const int top = std::max(a.row, b.row);
    const int right = std::min(a.column + a.columns, b.column + b.columns);
    const int bottom = std::min(a.row + a.rows, b.row + b.rows);
    return {left, top, std::max(right - left, 0), std::max(bottom - top, 0)};
}

ExtentIndex::ExtentIndex(std::vector<Window> windows) : windows_(std::move(windows)) {
    if (windows_.empty()) return;
    int left = windows_[0].column;
    int top = windows_[0].row;
    int right = left;
    int bottom = top;
    std::int64_t columns = 0;
    std::int64_t rows = 0;
    for (const Window& w : windows_) {
        left = std::min(left, w.column);
        top = std::min(top, w.row);
        right = std::max(right, w.column + w.columns);
        bottom = std::max(bottom, w.row + w.rows);
        columns += w.columns;
        rows += w.rows;
    }
    bounds_ = {left, top, right - left, bottom - top};
    // Of the windows' mean size, but not many more buckets than windows where these lie far apart.
    const auto count = static_cast<std::int64_t>(windows_.size());
    const int most = 1 + static_cast<int>(2 * std::sqrt(static_cast<double>(count)));
    bucket_columns_ = std::max({static_cast<int>(columns / count), bounds_.columns / most, 1});
    bucket_rows_ = std::max({static_cast<int>(rows / count), bounds_.rows / most, 1});
    across_ = (bounds_.columns + bucket_columns_ - 1) / bucket_columns_;
    down_ = (bounds_.rows + bucket_rows_ - 1) / bucket_rows_;
    inside_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_));
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        const Window b = buckets(windows_[i]);
        for (int r = b.row; r < b.row + b.rows; ++r)
            for (int c = b.column; c < b.column + b.columns; ++c)
                inside_[static_cast<std::size_t>(r) * static_cast<std::size_t>(across_) +
                        static_cast<std::size_t>(c)]
                    .push_back(static_cast<int>(i));
    }
}

Window ExtentIndex::buckets(Window window) const {
    const Window w = common_part(window, bounds_);
    if (w.columns == 0 || w.rows == 0) return {};
    const int left = (w.column - bounds_.column) / bucket_columns_;
    const int top = (w.row - bounds_.row) / bucket_rows_;
    const int right = (w.column - bounds_.column + w.columns - 1) / bucket_columns_;
    const int bottom = (w.row - bounds_.row + w.rows - 1) / bucket_rows_;
    return {left, top, right - left + 1, bottom - top + 1};
}

std::vector<int> ExtentIndex::meeting(Window window) const {
    std::vector<int> found;
    const Window b = buckets(window);
    for (int r = b.row; r < b.row + b.rows; ++r)
        for (int c = b.column; c < b.column + b.columns; ++c)
            for (const int i : inside_[static_cast<std::size_t>(r) * static_cast<std::size_t>(across_) +
                                       static_cast<std::size_t>(c)]) {
                const Window common = common_part(windows_[static_cast<std::size_t>(i)], window);
                if (common.columns > 0 && common.rows > 0) found.push_back(i);
            }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace relevo::ingest
