#include "ingest/surface_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relevo::ingest {

void add_statistics(const lod::Raster<float>& heights, lod::SceneInfo& info) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    info.valid_posts = 0;
    for (const float height : heights.samples()) {
        if (std::isnan(height)) continue;
        ++info.valid_posts;
        lowest = std::min(lowest, static_cast<double>(height));
        highest = std::max(highest, static_cast<double>(height));
    }
    info.void_posts = heights.samples().size() - info.valid_posts;
    info.height_min_m = info.valid_posts > 0 ? lowest : 0;
    info.height_max_m = info.valid_posts > 0 ? highest : 0;

    double largest = 0;
    for (int r = 0; r + 1 < heights.rows(); ++r) {
        const float* north = heights.row(r);
        const float* south = heights.row(r + 1);
        for (int c = 0; c + 1 < heights.columns(); ++c) {
            const double twist = static_cast<double>(north[c]) + static_cast<double>(south[c + 1]) -
                                 static_cast<double>(north[c + 1]) - static_cast<double>(south[c]);
            if (std::abs(twist) > largest) largest = std::abs(twist);  // false for NaN
        }
    }
    info.bilinear_mesh_max_m = largest / 4;
}

bool fits_int16(const lod::Raster<float>& heights) {
    return std::all_of(heights.samples().begin(), heights.samples().end(), [](float height) {
        return std::isnan(height) || (height > static_cast<float>(lod::kVoidInt16) && height <= 32767.0F);
    });
}

}  // namespace relevo::ingest
