#include "lod/mesh_heights.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::lod {

namespace {

bool has_void(const Raster<float>& heights) {
    return std::any_of(heights.samples().begin(), heights.samples().end(),
                       [](float H) { return std::isnan(H); });
}

/// Every second sample in both axes: the mean of the valid ones among its four.
Raster<float> half_size(const Raster<float>& fine) {
    Raster<float> coarse((fine.columns() + 1) / 2, (fine.rows() + 1) / 2);
    for (int row = 0; row < coarse.rows(); ++row) {
        for (int column = 0; column < coarse.columns(); ++column) {
            double sum = 0;
            int count = 0;
            for (int y = 2 * row; y < std::min(2 * row + 2, fine.rows()); ++y) {
                for (int x = 2 * column; x < std::min(2 * column + 2, fine.columns()); ++x) {
                    if (const float H = fine.at(x, y); !std::isnan(H)) {
                        sum += static_cast<double>(H);
                        ++count;
                    }
                }
            }
            coarse.at(column, row) = static_cast<float>(sum / count);  // 0 / 0: still a void
        }
    }
    return coarse;
}

/// Bilinear in the coarse raster at a sample of the fine one, whose samples lie a quarter cell off.
float from_coarse(const Raster<float>& coarse, int column, int row) {
    const auto neighbours = [](int fine, int size) {
        const int near = fine / 2;
        const int far = std::clamp(near + (fine % 2 == 0 ? -1 : 1), 0, size - 1);
        return std::pair(near, far);
    };
    const auto [x0, x1] = neighbours(column, coarse.columns());
    const auto [y0, y1] = neighbours(row, coarse.rows());
    return 0.75f * (0.75f * coarse.at(x0, y0) + 0.25f * coarse.at(x1, y0)) +
           0.25f * (0.75f * coarse.at(x0, y1) + 0.25f * coarse.at(x1, y1));
}

/// Pull (means of ever larger squares) and push (voids take the interpolated mean of the next coarser level).
/// \pre at least one sample is valid
void fill_voids(Raster<float>& heights) {
    if (!has_void(heights)) return;
    Raster<float> coarse = half_size(heights);
    fill_voids(coarse);
    for (int row = 0; row < heights.rows(); ++row) {
        for (int column = 0; column < heights.columns(); ++column) {
            float& H = heights.at(column, row);
            if (std::isnan(H)) H = from_coarse(coarse, column, row);
        }
    }
}

}  // namespace

Raster<float> mesh_heights(const geo::GridFrame& frame, const Raster<float>& heights) {
    Raster<float> filled = heights;
    const bool all_void = std::all_of(heights.samples().begin(), heights.samples().end(),
                                      [](float H) { return std::isnan(H); });
    if (all_void) {
        std::fill(filled.samples().begin(), filled.samples().end(), 0.0f);
    } else {
        fill_voids(filled);
    }

    const int side = frame.padded_side();
    Raster<float> padded(side, side);
    for (int row = 0; row < side; ++row) {
        const float* from = filled.row(std::min(row, filled.rows() - 1));
        float* to = padded.row(row);
        std::copy(from, from + filled.columns(), to);
        std::fill(to + filled.columns(), to + side, from[filled.columns() - 1]);
    }
    return padded;
}

}  // namespace relevo::lod
