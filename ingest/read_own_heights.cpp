#include <algorithm>
#include <cmath>

#include "ingest/read_heights.hpp"

namespace relevo::ingest {

Result<OwnHeights> read_own_heights(const Source& source, const OwnWindow& own, const Stage& stage) {
    constexpr int kStrip = 256;  // rows read at once
    const Window& window = own.window;
    OwnHeights read{lod::Raster<float>{window.columns, window.rows}, {}};
    double squares = 0;
    for (int first = 0; first < window.rows; first += kStrip) {
        const int count = std::min(kStrip, window.rows - first);
        const auto strip = source.read({window.column, window.row + first, window.columns, count});
        if (!strip) return strip.error();
        for (int r = 0; r < count; ++r) {
            const double* from = strip->row(r);
            float* to = read.heights.row(own.flip_rows ? window.rows - 1 - first - r : first + r);
            for (int c = 0; c < window.columns; ++c) {
                const double height = from[own.flip_columns ? window.columns - 1 - c : c];
                to[c] = static_cast<float>(height);
                if (std::isnan(height)) continue;
                const double rounding = std::abs(static_cast<double>(to[c]) - height);
                squares += rounding * rounding;
                read.rounding.max_m = std::max(read.rounding.max_m, rounding);
                ++read.rounding.posts;
            }
        }
        if (!stage(static_cast<double>(first + count) / window.rows)) return interrupted();
    }
    if (read.rounding.posts > 0)
        read.rounding.rms_m = std::sqrt(squares / static_cast<double>(read.rounding.posts));
    return read;
}

}  // namespace relevo::ingest
