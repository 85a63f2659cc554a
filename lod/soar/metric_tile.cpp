#include "lod/soar/metric_tile.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

/// A triangle's surface as a linear function of column and row: ECEF(corner 0) + columns * along + rows *
/// down.
struct TrianglePlane {
    glm::dvec3 origin;
    glm::dvec3 along;
    glm::dvec3 down;
};

TrianglePlane plane_through(const Triangle& t) {
    const double x1 = t.corner[1].column - t.corner[0].column;
    const double y1 = t.corner[1].row - t.corner[0].row;
    const double x2 = t.corner[2].column - t.corner[0].column;
    const double y2 = t.corner[2].row - t.corner[0].row;
    const double determinant = x1 * y2 - x2 * y1;
    const glm::dvec3 p1 = t.position[1] - t.position[0];
    const glm::dvec3 p2 = t.position[2] - t.position[0];
    return {t.position[0], (p1 * y2 - p2 * y1) / determinant, (p2 * x1 - p1 * x2) / determinant};
}

/// The columns in which a row meets a triangle. The sides have slopes 0, 1, -1 or none, so that these are
/// whole.
struct Columns {
    int first = std::numeric_limits<int>::max();
    int last = -1;
};

Columns columns_in_row(const GridPoint (&corner)[3], int row) {
    Columns columns;
    for (int k = 0; k < 3; ++k) {
        const GridPoint& a = corner[k];
        const GridPoint& b = corner[(k + 1) % 3];
        if (row < std::min(a.row, b.row) || row > std::max(a.row, b.row)) continue;
        const auto meet = [&](int column) {
            columns.first = std::min(columns.first, column);
            columns.last = std::max(columns.last, column);
        };
        if (a.row == b.row) {
            meet(a.column);
            meet(b.column);
        } else {
            meet(a.column + (row - a.row) * ((b.column - a.column) / (b.row - a.row)));
        }
    }
    return columns;
}

// Four doubles; GCC makes two SSE2 operations of each where there is no AVX. Neither fuses a product and a
// sum, so that results are the same bits everywhere.
using Four = double __attribute__((vector_size(32)));

// The same wherever it lies in memory. A typedef: in a `using`, clang passes over the alignment, and then
// loads from wherever it is as if it lay at a multiple of 32.
typedef double FourAnywhere __attribute__((vector_size(32), aligned(8), may_alias));

/// Largest squared distance of `count` posts from start, start + along, ...; a hole is NaN and never larger.
/// 1.5 ns a post (AVX2): nearly all of the time that metrics take is spent here.
[[gnu::target_clones("avx2", "default")]] double row_deviation(const double* x, const double* y,
                                                               const double* z, const double* hole, int count,
                                                               const glm::dvec3& start,
                                                               const glm::dvec3& along, double max_m2) {
    int i = 0;
    if (count >= 4) {
        Four most = {max_m2, max_m2, max_m2, max_m2};
        Four step = {0, 1, 2, 3};
        for (; i + 4 <= count; i += 4, step += 4.0) {
            const Four dx = start.x + step * along.x - *reinterpret_cast<const FourAnywhere*>(x + i);
            const Four dy = start.y + step * along.y - *reinterpret_cast<const FourAnywhere*>(y + i);
            const Four dz = start.z + step * along.z - *reinterpret_cast<const FourAnywhere*>(z + i);
            const Four m2 = dx * dx + dy * dy + dz * dz + *reinterpret_cast<const FourAnywhere*>(hole + i);
            most = m2 > most ? m2 : most;
        }
        for (int k = 0; k < 4; ++k) max_m2 = most[k] > max_m2 ? most[k] : max_m2;
    }
    for (; i < count; ++i) {
        const double step = i;
        const double dx = start.x + step * along.x - x[i];
        const double dy = start.y + step * along.y - y[i];
        const double dz = start.z + step * along.z - z[i];
        const double m2 = dx * dx + dy * dy + dz * dz + hole[i];
        max_m2 = m2 > max_m2 ? m2 : max_m2;
    }
    return max_m2;
}

}  // namespace

BlockGrid::Box MetricTile::window_of(const Box& tile, int padded_side, int halo) {
    const int left = std::max(tile.column - halo, 0);
    const int top = std::max(tile.row - halo, 0);
    const int right = std::min(tile.column + tile.columns + halo, padded_side);
    const int bottom = std::min(tile.row + tile.rows + halo, padded_side);
    return {left, top, right - left, bottom - top};
}

MetricTile::MetricTile(const MeshGround& ground, const Box& window, const Raster<float>& heights)
    : MetricTile(ground.positions, ground.undulations, window, heights, ground.fill.filled(window, heights)) {
}

MetricTile::MetricTile(const geo::PostPositions& positions, const UndulationGrid& undulations,
                       const Box& window, const Raster<float>& heights, const Raster<float>& filled)
    : window_(window) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const std::size_t count =
        static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows);
    for (auto* values : {&x_, &y_, &z_}) values->resize(count);
    hole_.assign(count, kNaN);
    std::size_t i = 0;
    for (int y = 0; y < window.rows; ++y) {
        const int row = window.row + y;
        for (int x = 0; x < window.columns; ++x, ++i) {
            const int column = window.column + x;
            if (x < heights.columns() && y < heights.rows() && !std::isnan(heights.at(x, y))) {
                hole_[i] = 0;
                any_valid_ = true;
            } else {
                all_valid_ = false;
            }
            const double H = static_cast<double>(filled.at(x, y));
            const glm::dvec3 p = positions.at(column, row, H + undulations.at(column, row));
            x_[i] = p.x;
            y_[i] = p.y;
            z_[i] = p.z;
        }
    }
}

Deviation MetricTile::deviation(const Triangle& triangle, const Box& box) const {
    const auto [top, bottom] =
        std::minmax({triangle.corner[0].row, triangle.corner[1].row, triangle.corner[2].row});
    const int first_row = std::max(top, box.row);
    const int last_row = std::min(bottom, box.row + box.rows - 1);
    Deviation result;
    if (first_row > last_row) return result;
    const TrianglePlane plane = plane_through(triangle);
    for (int row = first_row; row <= last_row; ++row) {
        auto [first, last] = columns_in_row(triangle.corner, row);
        first = std::max(first, box.column);
        last = std::min(last, box.column + box.columns - 1);
        if (first > last) continue;
        const glm::dvec3 start = plane.origin +
                                 static_cast<double>(row - triangle.corner[0].row) * plane.down +
                                 static_cast<double>(first - triangle.corner[0].column) * plane.along;
        const std::size_t i = index(first, row);
        result.max_m2 = row_deviation(&x_[i], &y_[i], &z_[i], &hole_[i], last - first + 1, start, plane.along,
                                      result.max_m2);
    }
    return result;
}

}  // namespace relevo::lod
