#include "lod/soar/coarse_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "lod/machine_clones.hpp"

namespace relevo::lod {

namespace {

constexpr int kSquare = MeshHeights::kCell;
// More than what rounding at the earth's radius may take from a distance: squares are left out only when the
// posts in them are surely nearer.
constexpr double kRoundingM = 1e-7;

}  // namespace

/// A triangle's surface as a linear function of column and row.
struct CoarseScan::Plane {
    explicit Plane(const Triangle& t) : corner(t.corner[0]), origin(t.position[0]) {
        const double x1 = t.corner[1].column - t.corner[0].column;
        const double y1 = t.corner[1].row - t.corner[0].row;
        const double x2 = t.corner[2].column - t.corner[0].column;
        const double y2 = t.corner[2].row - t.corner[0].row;
        const double determinant = x1 * y2 - x2 * y1;
        const glm::dvec3 p1 = t.position[1] - t.position[0];
        const glm::dvec3 p2 = t.position[2] - t.position[0];
        along = (p1 * y2 - p2 * y1) / determinant;
        down = (p2 * x1 - p1 * x2) / determinant;
    }
    glm::dvec3 at(int column, int row) const {
        return origin + static_cast<double>(row - corner.row) * down +
               static_cast<double>(column - corner.column) * along;
    }

    GridPoint corner;
    glm::dvec3 origin;
    glm::dvec3 along;
    glm::dvec3 down;
};

namespace {

/// Distances of posts from start, start + step, ...
[[RELEVO_CLONES("avx2", "default")]] void distances(const double* x, const double* y, const double* z,
                                                    int count, const glm::dvec3& start,
                                                    const glm::dvec3& step, double* distance) {
    const double sx = start.x, sy = start.y, sz = start.z;
    const double ax = step.x, ay = step.y, az = step.z;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
        const double dx = sx + i * ax - x[i];
        const double dy = sy + i * ay - y[i];
        const double dz = sz + i * az - z[i];
        distance[i] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
}

}  // namespace

void CoarseScan::prepare(const MetricTile& posts, const FineMetrics& fine, const BlockGrid::Box& box) {
    posts_ = &posts;
    box_ = box;
    across_ = (box.columns - 1) / kSquare + 1;
    const int down = (box.rows - 1) / kSquare + 1;
    const std::size_t count = static_cast<std::size_t>(across_) * static_cast<std::size_t>(down);
    for (auto* values : {&x_, &y_, &z_, &hole_, &detail_, &distance_}) values->resize(count);
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    std::size_t k = 0;
    for (int row = box.row; row < box.row + box.rows; row += kSquare) {
        for (int column = box.column; column < box.column + box.columns; column += kSquare, ++k) {
            const GridPoint p{column, row};
            const glm::dvec3 position = posts.position(p);
            x_[k] = position.x;
            y_[k] = position.y;
            z_[k] = position.z;
            hole_[k] = posts.is_valid(p) ? 0 : nothing;
            if (column + kSquare >= box.column + box.columns || row + kSquare >= box.row + box.rows) continue;
            const GridPoint centre{column + kSquare / 2, row + kSquare / 2};
            detail_[k] = fine.radius(centre) > 0 ? static_cast<double>(fine.bounded(centre)) : -1;
        }
    }
}

/// The columns in which a row meets a triangle. The sides have slopes 0, 1, -1 or none, so that these are
/// whole.
CoarseScan::Columns CoarseScan::columns_in_row(const Triangle& triangle, int row) {
    Columns columns{std::numeric_limits<int>::max(), -1};
    for (std::size_t k = 0; k < 3; ++k) {
        const GridPoint& a = triangle.corner[k];
        const GridPoint& b = triangle.corner[(k + 1) % 3];
        if (row < std::min(a.row, b.row) || row > std::max(a.row, b.row)) continue;
        const auto meet = [&](int column) {
            columns.first = std::min(columns.first, column);
            columns.last = std::max(columns.last, column);
        };
        const int slope = (b.column > a.column ? 1 : 0) - (b.column < a.column ? 1 : 0);
        if (a.row == b.row) {
            meet(a.column);
            meet(b.column);
        } else {
            meet(a.column + slope * std::abs(row - a.row));
        }
    }
    return columns;
}

/// Of the lattice's posts in a row; the largest one of those that are valid, or what was the largest before.
double CoarseScan::distances_in_row(const Plane& plane, int j, Columns columns, double largest) {
    const std::size_t k = static_cast<std::size_t>(j) * static_cast<std::size_t>(across_) +
                          static_cast<std::size_t>(columns.first);
    const int count = columns.last - columns.first + 1;
    distances(&x_[k], &y_[k], &z_[k], count,
              plane.at(box_.column + kSquare * columns.first, box_.row + kSquare * j),
              static_cast<double>(kSquare) * plane.along, &distance_[k]);
    for (std::size_t i = k; i < k + static_cast<std::size_t>(count); ++i) {
        const double m = distance_[i] + hole_[i];
        largest = m > largest ? m : largest;
    }
    return largest;
}

/// Looks at every post of a square, as far as it lies in the triangle.
double CoarseScan::scan_square(const Triangle& triangle, const Plane& plane, int i, int j,
                               double largest2) const {
    const int left = box_.column + kSquare * i;
    const int top = box_.row + kSquare * j;
    for (int row = top; row <= top + kSquare; ++row) {
        const Columns in_row = columns_in_row(triangle, row);
        const int first = std::max(in_row.first, left);
        const int last = std::min(in_row.last, left + kSquare);
        for (int column = first; column <= last; ++column) {
            const GridPoint p{column, row};
            const glm::dvec3 d = plane.at(column, row) - posts_->position(p);
            const double m2 = glm::dot(d, d);
            if (m2 > largest2 && posts_->is_valid(p)) largest2 = m2;
        }
    }
    return largest2;
}

double CoarseScan::largest_distance(const Triangle& triangle, double known_m) {
    const auto [top, bottom] =
        std::minmax({triangle.corner[0].row, triangle.corner[1].row, triangle.corner[2].row});
    const int first_row = (std::max(top, box_.row) - box_.row) / kSquare;
    const int last_row = (std::min(bottom, box_.row + box_.rows - 1) - box_.row) / kSquare;
    const Plane plane(triangle);
    const auto lattice_columns = [&](int j) {
        const Columns in_row = columns_in_row(triangle, box_.row + kSquare * j);
        return Columns{(std::max(in_row.first, box_.column) - box_.column) / kSquare,
                       (std::min(in_row.last, box_.column + box_.columns - 1) - box_.column) / kSquare -
                           (in_row.last < box_.column ? 1 : 0)};
    };

    double largest = known_m;
    for (int j = first_row; j <= last_row; ++j) {
        const Columns columns = lattice_columns(j);
        if (columns.first <= columns.last) largest = distances_in_row(plane, j, columns, largest);
    }
    for (int j = first_row; j < last_row; ++j) {
        const Columns upper = lattice_columns(j);
        const Columns lower = lattice_columns(j + 1);
        const double* distance = distance_.data() + static_cast<std::ptrdiff_t>(j) * across_;
        for (int i = std::min(upper.first, lower.first); i < std::max(upper.last, lower.last); ++i) {
            double corners = 0;
            const auto look = [&](const Columns& columns, int at, const double* row) {
                if (at >= columns.first && at <= columns.last) corners = std::max(corners, row[at]);
            };
            look(upper, i, distance);
            look(upper, i + 1, distance);
            look(lower, i, distance + across_);
            look(lower, i + 1, distance + across_);
            const double detail = detail_[static_cast<std::size_t>(j * across_ + i)];
            if (detail < 0 || corners + detail + kRoundingM <= largest) continue;
            const double largest2 = largest > 0 ? largest * largest : 0;
            const double found2 = scan_square(triangle, plane, i, j, largest2);
            if (found2 > largest2) largest = std::sqrt(found2);
        }
    }
    return largest;
}

}  // namespace relevo::lod
