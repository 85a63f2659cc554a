#include "lod/undulation_grid.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "lod/machine_clones.hpp"

namespace relevo::lod {
namespace {

double undulation(const geo::Geoid& geoid, const geo::GridFrame& frame, geo::GridPosition at) {
    return geoid.undulation(frame.lat_lon(at)).m;
}

int nodes_a_side(const geo::GridFrame& frame, int shift) {
    return (1 << (frame.levels() - shift)) + 1;
}

Raster<float> nodes_of(const geo::Geoid& geoid, const geo::GridFrame& frame, int shift) {
    const int side = nodes_a_side(frame, shift);
    Raster<float> nodes(side, side);
    tbb::parallel_for(tbb::blocked_range<int>(0, side), [&](const tbb::blocked_range<int>& rows) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
            for (int column = 0; column < side; ++column) {
                const geo::GridPosition place{std::ldexp(column, shift), std::ldexp(row, shift)};
                nodes.at(column, row) = static_cast<float>(undulation(geoid, frame, place));
            }
        }
    });
    return nodes;
}

/// Largest difference of a bilinear grid from the geoid over the data, at the middle of each cell of nodes
/// and of its north and west side: there a bilinear function is farthest from a smooth one.
double measured_error(const UndulationGrid& grid, const geo::Geoid& geoid, const geo::GridFrame& frame) {
    const double step = std::ldexp(1, grid.shift());
    const int cells = nodes_a_side(frame, grid.shift()) - 1;
    const int cell_rows = std::min(static_cast<int>((frame.rows - 1) / step) + 1, cells);
    const int cell_columns = std::min(static_cast<int>((frame.columns - 1) / step) + 1, cells);
    const std::array<geo::GridPosition, 3> middles{{{0.5, 0.5}, {0.5, 0}, {0, 0.5}}};
    const auto worst_of_rows = [&](const tbb::blocked_range<int>& rows, double worst) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
            for (int column = 0; column < cell_columns; ++column) {
                for (const geo::GridPosition& middle : middles) {
                    const geo::GridPosition place{(column + middle.column) * step, (row + middle.row) * step};
                    worst = std::max(worst, std::abs(grid.at(place) - undulation(geoid, frame, place)));
                }
            }
        }
        return worst;
    };
    return tbb::parallel_reduce(tbb::blocked_range<int>(0, cell_rows), 0.0, worst_of_rows,
                                [](double a, double b) { return std::max(a, b); });
}

/// The coarsest spacing worth a try: cells of 1/16 degree (of latitude, in a polar grid), a quarter of those
/// of the geoid's own grid, so that the middles of cells do not step over what the geoid does between them.
int coarsest_shift(const geo::GridFrame& frame) {
    constexpr double kMetresPerDegree = 111e3;
    const double widest = (frame.is_polar() ? kMetresPerDegree : 1) / 16;
    int shift = 0;
    while (shift < frame.levels() && std::ldexp(std::max(frame.step_x, frame.step_y), shift + 1) <= widest)
        ++shift;
    return shift;
}

/// Bilinear: of `count` posts in a row from `column` on, whose places in the cell are u and v.
[[RELEVO_CLONES("avx2", "default")]] void add_in_cell(int column, double cells_per_post, int cell, double v,
                                                      const double* upper, const double* lower, int count,
                                                      double* heights_m) {
    const double a = upper[0], b = upper[1], c = lower[0], d = lower[1];
    for (int i = 0; i < count; ++i) {
        const double u = (column + i) * cells_per_post - cell;
        heights_m[i] += (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
    }
}

}  // namespace

UndulationGrid::UndulationGrid(std::shared_ptr<const geo::Geoid> geoid, const geo::GridFrame& frame)
    : geoid_(std::move(geoid)), frame_(frame) {
    if (!geoid_) return;
    const int coarsest = coarsest_shift(frame);
    // A tenth is kept for the places that are not measured.
    constexpr double kLimit = 0.9 * kMaxErrorM;
    for (shift_ = coarsest; shift_ >= 0; --shift_) {
        const int side = nodes_a_side(frame, shift_);
        if (static_cast<long long>(side) * side > kMostNodes) break;
        nodes_ = nodes_of(*geoid_, frame, shift_);
        cells_per_post_ = std::ldexp(1, -shift_);
        if (measured_error(*this, *geoid_, frame) <= kLimit) return;
    }
    nodes_ = {};
    shift_ = coarsest;
}

double UndulationGrid::at(int column, int row) const {
    return at(geo::GridPosition{static_cast<double>(column), static_cast<double>(row)});
}

void UndulationGrid::add_row(int column, int row, int count, double* heights_m) const {
    if (nodes_.columns() == 0) {
        for (int i = 0; geoid_ && i < count; ++i) heights_m[i] += at(column + i, row);
        return;
    }
    const double y = row * cells_per_post_;
    const int node_row = std::clamp(static_cast<int>(y), 0, nodes_.rows() - 2);
    const double v = y - node_row;
    for (int i = 0; i < count;) {
        const int cell = std::min((column + i) >> shift_, nodes_.columns() - 2);
        const int cell_end = cell == nodes_.columns() - 2 ? column + count : (cell + 1) << shift_;
        const double upper[] = {nodes_.at(cell, node_row), nodes_.at(cell + 1, node_row)};
        const double lower[] = {nodes_.at(cell, node_row + 1), nodes_.at(cell + 1, node_row + 1)};
        const int end = std::min(cell_end - column, count);
        add_in_cell(column + i, cells_per_post_, cell, v, upper, lower, end - i, heights_m + i);
        i = end;
    }
}

double UndulationGrid::at(geo::GridPosition place) const {
    if (nodes_.columns() == 0) return geoid_ ? undulation(*geoid_, frame_, place) : 0;
    const double x = place.column * cells_per_post_;
    const double y = place.row * cells_per_post_;
    const int column = std::clamp(static_cast<int>(x), 0, nodes_.columns() - 2);
    const int row = std::clamp(static_cast<int>(y), 0, nodes_.rows() - 2);
    const double u = x - column;
    const double v = y - row;
    const float* upper = nodes_.row(row) + column;
    const float* lower = nodes_.row(row + 1) + column;
    return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

}  // namespace relevo::lod
