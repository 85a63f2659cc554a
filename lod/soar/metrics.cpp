#include "lod/soar/metrics.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "geo/post_positions.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/soar/diamond.hpp"
#include "lod/soar/metric_code.hpp"

namespace relevo::lod {

namespace {

/// Object-space errors below this are none: rounding of positions at the earth's radius is 1e-9 m.
constexpr double kNegligibleM = 1e-8;
/// Spheres are nested with this to spare, so that their order survives evaluation in double.
constexpr double kRadiusMarginM = 1e-6;

/// The largest squared distance between a surface and the posts under it.
struct Deviation {
    double max_m2 = 0;
    bool any_post = false;

    void join(const Deviation& other) {
        max_m2 = std::max(max_m2, other.max_m2);
        any_post = any_post || other.any_post;
    }
};

/// A triangle's surface as a linear function of column and row: ECEF(origin) + column * along + row * down.
struct TrianglePlane {
    glm::dvec3 origin;
    glm::dvec3 along;
    glm::dvec3 down;
};

TrianglePlane plane_through(const GridPoint (&corner)[3], const glm::dvec3 (&position)[3]) {
    const double x1 = corner[1].column - corner[0].column;
    const double y1 = corner[1].row - corner[0].row;
    const double x2 = corner[2].column - corner[0].column;
    const double y2 = corner[2].row - corner[0].row;
    const double determinant = x1 * y2 - x2 * y1;
    const glm::dvec3 p1 = position[1] - position[0];
    const glm::dvec3 p2 = position[2] - position[0];
    return {position[0], (p1 * y2 - p2 * y1) / determinant, (p2 * x1 - p1 * x2) / determinant};
}

class MetricBuilder {
  public:
    MetricBuilder(const geo::GridFrame& frame, const UndulationGrid& undulations,
                  const Raster<float>& heights)
        : frame_(frame),
          levels_(frame.levels()),
          positions_(frame),
          undulations_(undulations),
          mesh_H_(mesh_heights(frame, heights)),
          true_h_(frame.columns, frame.rows) {
        tbb::parallel_for(0, frame.rows, [&](int row) {
            for (int column = 0; column < frame_.columns; ++column) {
                true_h_.at(column, row) =
                    static_cast<double>(heights.at(column, row)) + undulations_.at(column, row);
            }
        });
        const int side = frame.padded_side();
        metrics_ = {Raster<std::uint16_t>(side, side), Raster<std::uint16_t>(side, side),
                    Raster<std::uint16_t>(side, side)};
    }

    std::optional<MetricRasters> build(const std::function<bool(double)>& go_on) {
        const int side = frame_.padded_side();
        for (int level = 2 * levels_ - 1; level >= 0; --level) {
            tbb::parallel_for(0, side, [&](int row) {
                for_each_vertex_in_row(levels_, level, row,
                                       [&](const GridPoint& v) { build_vertex(v, level); });
            });
            if (!go_on(1 - level / (2.0 * levels_))) return std::nullopt;
        }
        return std::move(metrics_);
    }

  private:
    glm::dvec3 position(const GridPoint& p) const {
        return positions_.at(
            p.column, p.row,
            static_cast<double>(mesh_H_.at(p.column, p.row)) + undulations_.at(p.column, p.row));
    }

    bool is_valid(const GridPoint& p) const {
        return p.column < frame_.columns && p.row < frame_.rows && !std::isnan(true_h_.at(p.column, p.row));
    }

    void build_vertex(const GridPoint& v, int level) {
        const Diamond d = diamond(v, level, levels_);
        const glm::dvec3 here = position(v);
        const glm::dvec3 left = position(d.left);
        const glm::dvec3 right = position(d.right);

        Deviation deviation;
        double radius = std::max(glm::distance(here, left), glm::distance(here, right));
        for (const GridPoint& apex : d.apexes) {
            const glm::dvec3 top = position(apex);
            radius = std::max(radius, glm::distance(here, top));
            deviation.join(scan({d.left, d.right, apex}, {left, right, top}));
        }
        double incremental = is_valid(v) ? glm::distance(here, 0.5 * (left + right)) : 0.0;
        if (incremental < kNegligibleM) incremental = 0;
        double bounded = std::sqrt(deviation.max_m2);
        if (bounded < kNegligibleM) bounded = 0;

        std::uint16_t bounded_code = encode_up(bounded);
        std::uint16_t incremental_code = encode_up(incremental);
        bool empty = !deviation.any_post;
        for (const GridPoint& child : children(v, level, levels_)) {
            const std::uint16_t child_radius = metrics_.radius.at(child.column, child.row);
            if (child_radius == 0) continue;
            empty = false;
            bounded_code = std::max(bounded_code, metrics_.bounded.at(child.column, child.row));
            incremental_code = std::max(incremental_code, metrics_.incremental.at(child.column, child.row));
            radius = std::max(
                radius, glm::distance(here, position(child)) + static_cast<double>(decode(child_radius)));
        }
        if (empty) return;  // the codes stay 0: never drawn, and no sphere to look into
        metrics_.bounded.at(v.column, v.row) = bounded_code;
        metrics_.incremental.at(v.column, v.row) = incremental_code;
        metrics_.radius.at(v.column, v.row) = encode_up(radius + kRadiusMarginM);
    }

    /// Compares a triangle with every valid post in it, border included, at the same grid coordinates.
    Deviation scan(const GridPoint (&corner)[3], const glm::dvec3 (&corner_position)[3]) const {
        const auto [top, bottom] = std::minmax({corner[0].row, corner[1].row, corner[2].row});
        const int last_row = std::min(bottom, frame_.rows - 1);
        if (top > last_row) return {};
        const TrianglePlane plane = plane_through(corner, corner_position);
        const auto scan_rows = [&](int first, int last, Deviation deviation) {
            for (int row = first; row <= last; ++row) scan_row(corner, plane, row, deviation);
            return deviation;
        };
        constexpr int kRowsWorthSharing = 128;
        if (last_row - top < kRowsWorthSharing) return scan_rows(top, last_row, {});
        return tbb::parallel_reduce(
            tbb::blocked_range<int>(top, last_row + 1, 16), Deviation{},
            [&](const tbb::blocked_range<int>& rows, Deviation deviation) {
                return scan_rows(rows.begin(), rows.end() - 1, deviation);
            },
            [](Deviation a, const Deviation& b) {
                a.join(b);
                return a;
            });
    }

    void scan_row(const GridPoint (&corner)[3], const TrianglePlane& plane, int row,
                  Deviation& deviation) const {
        // The sides have slopes 0, 1, -1 or none, so that a row meets them at whole columns.
        int first = frame_.columns;
        int last = -1;
        for (int k = 0; k < 3; ++k) {
            const GridPoint& a = corner[k];
            const GridPoint& b = corner[(k + 1) % 3];
            if (row < std::min(a.row, b.row) || row > std::max(a.row, b.row)) continue;
            const auto meet = [&](int column) {
                first = std::min(first, column);
                last = std::max(last, column);
            };
            if (a.row == b.row) {
                meet(a.column);
                meet(b.column);
            } else {
                meet(a.column + (row - a.row) * ((b.column - a.column) / (b.row - a.row)));
            }
        }
        last = std::min(last, frame_.columns - 1);
        if (first > last) return;

        const double* h = true_h_.row(row);
        const glm::dvec3 start = plane.origin + static_cast<double>(row - corner[0].row) * plane.down;
        double max_m2 = deviation.max_m2;
        bool any_post = deviation.any_post;
        for (int column = first; column <= last; ++column) {
            const glm::dvec3 drawn = start + static_cast<double>(column - corner[0].column) * plane.along;
            const glm::dvec3 miss = drawn - positions_.at(column, row, h[column]);
            const double m2 = glm::dot(miss, miss);
            if (m2 > max_m2) max_m2 = m2;  // a void is NaN and compares false
            any_post |= m2 >= 0;
        }
        deviation = {max_m2, any_post};
    }

    const geo::GridFrame& frame_;
    int levels_;
    geo::PostPositions positions_;
    const UndulationGrid& undulations_;
    Raster<float> mesh_H_;   // padded, no voids
    Raster<double> true_h_;  // of the data, void = NaN
    MetricRasters metrics_;
};

}  // namespace

MetricRasters build_metrics(const geo::GridFrame& frame, const UndulationGrid& undulations,
                            const Raster<float>& heights) {
    return *build_metrics(frame, undulations, heights, [](double) { return true; });
}

std::optional<MetricRasters> build_metrics(const geo::GridFrame& frame, const UndulationGrid& undulations,
                                           const Raster<float>& heights,
                                           const std::function<bool(double)>& go_on) {
    return MetricBuilder(frame, undulations, heights).build(go_on);
}

}  // namespace relevo::lod
