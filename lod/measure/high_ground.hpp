#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lod/measure/height_sampler.hpp"
#include "lod/scene/block_grid.hpp"

namespace relevo::lod {

/// Heights above the ellipsoid of a box of posts, and the highest of ever larger squares of cells. A cell
/// with a void corner is infinitely high there, so that no line is taken to pass over it unseen.
class HighGround {
  public:
    /// \param H  of the box, above the scene's vertical datum; NaN where void
    HighGround(const Scene& scene, const BlockGrid::Box& box, const Raster<float>& H);

    struct Cell {
        double nw;
        double ne;
        double sw;
        double se;
        double at(double u, double v) const {
            const double north = nw + u * (ne - nw);
            const double south = sw + u * (se - sw);
            return north + v * (south - north);
        }
    };
    /// \pre it is one of the box's; of a box one post wide the same post twice
    Cell cell(int column, int row) const {
        const int east = std::min(column + 1, h_.columns() - 1);
        const int south = std::min(row + 1, h_.rows() - 1);
        return {h_.at(column, row), h_.at(east, row), h_.at(column, south), h_.at(east, south)};
    }
    int cell_column(double column) const {
        return std::clamp(static_cast<int>(std::floor(column)), 0, levels_[0].columns() - 1);
    }
    int cell_row(double row) const {
        return std::clamp(static_cast<int>(std::floor(row)), 0, levels_[0].rows() - 1);
    }

    double post(int column, int row) const { return h_.at(column, row); }

    /// As GridPath has it, of the box: where that ends before the data does, no line goes.
    bool inside(double column, double row) const {
        constexpr double kSlack = 0.5 * HeightSampler::kPostTolerance;
        return column >= -kSlack && row >= -kSlack && column <= h_.columns() - 1 + kSlack &&
               row <= h_.rows() - 1 + kSlack;
    }

    /// Nothing between these columns and rows is higher.
    double highest(double west, double east, double north, double south) const {
        int x0 = cell_column(west);
        int x1 = cell_column(east);
        int y0 = cell_row(north);
        int y1 = cell_row(south);
        std::size_t level = 0;
        while (x1 - x0 > 1 || y1 - y0 > 1) {
            ++level;
            x0 /= 2;
            x1 /= 2;
            y0 /= 2;
            y1 /= 2;
        }
        const Raster<float>& cells = levels_[level];
        float most = -std::numeric_limits<float>::infinity();
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) most = std::max(most, cells.at(x, y));
        }
        return static_cast<double>(most);
    }

  private:
    Raster<double> h_;
    std::vector<Raster<float>> levels_;
};

}  // namespace relevo::lod
