#include "lod/measure/cell_sums.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/angle.hpp"

namespace relevo::lod {
namespace {

struct Node {
    double at;  // in [0, 1]
    double weight;
};
constexpr double kOff2 = 0.28867513459481287;  // sqrt(1/12)
constexpr double kOff3 = 0.3872983346207417;   // sqrt(3/20)
constexpr double kOff5a = 0.26923465505284155;
constexpr double kOff5b = 0.45308992296933199;
constexpr std::array<Node, 2> kTwo{{{0.5 - kOff2, 0.5}, {0.5 + kOff2, 0.5}}};
constexpr std::array<Node, 3> kThree{{{0.5 - kOff3, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + kOff3, 5.0 / 18}}};
constexpr std::array<Node, 5> kFive{{{0.5 - kOff5b, 0.11846344252809454},
                                     {0.5 - kOff5a, 0.23931433524968324},
                                     {0.5, 0.28444444444444444},
                                     {0.5 + kOff5a, 0.23931433524968324},
                                     {0.5 + kOff5b, 0.11846344252809454}}};

double parabola(const std::array<double, 3>& at, double v) {
    return at[0] + v * (4 * at[1] - 3 * at[0] - at[2] + 2 * v * (at[0] - 2 * at[1] + at[2]));
}

/// A bilinear function along a row: value + per_u * u.
struct Along {
    double value;
    double per_u;
};

Along along(const BilinearCell& c, double v) {
    const double west = c.nw + v * (c.sw - c.nw);
    const double east = c.ne + v * (c.se - c.ne);
    return {west, east - west};
}

double per_v(const BilinearCell& c, double u) {
    return (c.sw - c.nw) + u * ((c.se - c.ne) - (c.sw - c.nw));
}

/// A side of a ring; sides along a row add nothing.
struct Edge {
    double u0;
    double v0;
    double u1;
    double v1;
    double u(double v) const { return u0 + (v - v0) / (v1 - v0) * (u1 - u0); }
};

/// Integral of max(value + per_u * t, 0) for t from 0 to u.
double positive_part(Along f, double u) {
    const double end = f.value + f.per_u * u;
    if (f.value >= 0 && end >= 0) return u * (f.value + 0.5 * f.per_u * u);
    if (f.value <= 0 && end <= 0) return 0;
    return f.value > 0 ? -0.5 * f.value * f.value / f.per_u : 0.5 * end * end / f.per_u;
}

class CellIntegrals {
  public:
    CellIntegrals(const GroundCell& cell, std::optional<double> plane, CellSums& sums)
        : cell_(cell), plane_(plane), sums_(sums) {
        const BilinearCell& H = cell.H;
        twist_ = H.nw - H.ne - H.sw + H.se;
        const double change = std::abs(twist_) / std::min(std::min(cell.column_m[0], cell.column_m[2]),
                                                          std::min(cell.row_m[0], cell.row_m[2]));
        constexpr double kGentle = 0.1;
        constexpr double kSteep = 0.5;
        gentle_ = change < kGentle;
        constexpr double kMostSteps = 16;
        // At a pole columns have no width: the posts there are one, and any number of steps does.
        if (std::isfinite(change))
            steps_ = static_cast<int>(std::clamp(std::ceil(change / kSteep), 1.0, kMostSteps));
        if (plane) {
            const auto [low, high] = std::minmax({H.nw, H.ne, H.sw, H.se});
            crosses_plane_ = low < *plane && high > *plane;
            all_above_ = low >= *plane;
        }
    }

    void add(const Edge& edge) {
        if (edge.v0 == edge.v1 || (edge.u0 == 0 && edge.u1 == 0)) return;
        double area = 0;
        double volume = 0;
        for (const Node& node : kThree) {
            const double v = edge.v0 + node.at * (edge.v1 - edge.v0);
            const double u = edge.u(v);
            const double part = node.weight * (edge.v1 - edge.v0) * metric(v);
            const Along H = along(cell_.H, v);
            area += part * u;
            volume += part * u * (H.value + 0.5 * H.per_u * u);
        }
        sums_.area_m2 += area;
        sums_.H_m3 += volume;
        if (plane_ && all_above_) sums_.above_m3 += volume - area * *plane_;
        if (crosses_plane_) add_above(edge);
        for (int i = 0; i < steps_; ++i) {
            const double begin = edge.v0 + (edge.v1 - edge.v0) * i / steps_;
            const double end = edge.v0 + (edge.v1 - edge.v0) * (i + 1) / steps_;
            gentle_ ? add_surface(edge, begin, end, kTwo) : add_surface(edge, begin, end, kThree);
        }
    }

    /// Extremes at a corner of the ring: H is bilinear, and the slope's square convex, so that they are at
    /// corners or (H alone) along slanted sides.
    void note(double u, double v) {
        const geo::GridPosition place{cell_.H.column + u, cell_.H.row + v};
        const Along H = along(cell_.H, v);
        note_height(H.value + u * H.per_u, place);
        const double slope = std::hypot(H.per_u / column_m(v), per_v(cell_.H, u) / row_m(v));
        if (std::isfinite(slope) && (!sums_.steepest || slope > sums_.steepest->value))
            sums_.steepest = {slope, place};
    }

    void note_along(const Edge& edge) {
        const double du = edge.u1 - edge.u0;
        const double dv = edge.v1 - edge.v0;
        const double curvature = 2 * twist_ * du * dv;
        if (curvature == 0) return;
        // dH/dt at t = 0 of the straight side.
        const double rise = du * along(cell_.H, edge.v0).per_u + dv * per_v(cell_.H, edge.u0);
        const double t = -rise / curvature;
        if (!(t > 0 && t < 1)) return;
        const double u = edge.u0 + t * du;
        const double v = edge.v0 + t * dv;
        const Along H = along(cell_.H, v);
        note_height(H.value + u * H.per_u, {cell_.H.column + u, cell_.H.row + v});
    }

  private:
    double column_m(double v) const { return parabola(cell_.column_m, v); }
    double row_m(double v) const { return parabola(cell_.row_m, v); }
    double metric(double v) const { return column_m(v) * row_m(v); }

    void note_height(double H, const geo::GridPosition& place) {
        if (!sums_.lowest || H < sums_.lowest->value) sums_.lowest = {H, place};
        if (!sums_.highest || H > sums_.highest->value) sums_.highest = {H, place};
    }

    template <std::size_t kCount>
    void add_surface(const Edge& edge, double begin, double end, const std::array<Node, kCount>& nodes) {
        for (const Node& outer : nodes) {
            const double v = begin + outer.at * (end - begin);
            const double width = edge.u(v) / steps_;
            const double columns = 1 / column_m(v);
            const double rows = 1 / row_m(v);
            const double part = outer.weight * (end - begin) * width * metric(v);
            const Along H = along(cell_.H, v);
            const Along h = along(cell_.h, v);
            const double east2 = H.per_u * columns * H.per_u * columns;
            const double h_east2 = h.per_u * columns * h.per_u * columns;
            for (int i = 0; i < steps_; ++i) {
                for (const Node& inner : nodes) {
                    const double u = (i + inner.at) * width;
                    const double scale = 1 + (h.value + u * h.per_u) * cell_.curvature;
                    const double h_south = per_v(cell_.h, u) * rows;
                    const double south = per_v(cell_.H, u) * rows;
                    sums_.surface_m2 +=
                        part * inner.weight * scale * std::sqrt(scale * scale + h_east2 + h_south * h_south);
                    sums_.slope_degrees_m2 +=
                        part * inner.weight *
                        geo::Degrees::from_radians(std::atan(std::sqrt(east2 + south * south))).value;
                }
            }
        }
    }

    /// The volume above the plane: split where the plane is met at u = 0 and along the side.
    void add_above(const Edge& edge) {
        std::array<double, 5> cuts{0, 1, 1, 1, 1};  // of t along the side, rising
        const auto cut = [&](double t) {
            if (!(t > 0 && t < 1)) return;
            for (double& other : cuts) {
                if (t < other) std::swap(t, other);
            }
        };
        const double dv = edge.v1 - edge.v0;
        const double du = edge.u1 - edge.u0;
        const Along H0 = along(cell_.H, edge.v0);
        const double west = along(cell_.H, edge.v1).value - H0.value;
        if (west != 0) cut((*plane_ - H0.value) / west);
        const double a = twist_ * du * dv;
        const double b = du * H0.per_u + dv * per_v(cell_.H, edge.u0);
        const double c = H0.value + edge.u0 * H0.per_u - *plane_;
        const double root = b * b - 4 * a * c;
        if (root >= 0) {
            const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
            if (a != 0) cut(q / a);
            if (q != 0) cut(c / q);
        }
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            if (cuts[i] == cuts[i + 1]) continue;
            const double begin = edge.v0 + cuts[i] * dv;
            const double end = edge.v0 + cuts[i + 1] * dv;
            for (const Node& node : kFive) {
                const double v = begin + node.at * (end - begin);
                Along H = along(cell_.H, v);
                H.value -= *plane_;
                sums_.above_m3 += node.weight * (end - begin) * metric(v) * positive_part(H, edge.u(v));
            }
        }
    }

    const GroundCell& cell_;
    std::optional<double> plane_;
    CellSums& sums_;
    double twist_ = 0;
    bool gentle_ = false;
    int steps_ = 1;
    bool crosses_plane_ = false;
    bool all_above_ = false;
};

}  // namespace

void CellSums::add(const CellSums& other) {
    void_m2 += other.void_m2;
    area_m2 += other.area_m2;
    surface_m2 += other.surface_m2;
    H_m3 += other.H_m3;
    slope_degrees_m2 += other.slope_degrees_m2;
    above_m3 += other.above_m3;
    if (other.lowest && (!lowest || other.lowest->value < lowest->value)) lowest = other.lowest;
    if (other.highest && (!highest || other.highest->value > highest->value)) highest = other.highest;
    if (other.steepest && (!steepest || other.steepest->value > steepest->value)) steepest = other.steepest;
}

void add_cell(const GroundCell& cell, const GridRing& ring, std::optional<double> plane_m, CellSums& sums) {
    CellIntegrals integrals(cell, plane_m, sums);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const geo::GridPosition& a = ring[i];
        const geo::GridPosition& b = ring[i + 1 < ring.size() ? i + 1 : 0];
        const Edge edge{a.column, a.row, b.column, b.row};
        integrals.add(edge);
        integrals.note(a.column, a.row);
        integrals.note_along(edge);
    }
}

void add_whole_cell(const GroundCell& cell, std::optional<double> plane_m, CellSums& sums) {
    CellIntegrals integrals(cell, plane_m, sums);
    integrals.add({1, 0, 1, 1});
    for (const double v : {0.0, 1.0}) {
        integrals.note(0, v);
        integrals.note(1, v);
    }
}

double cell_area(const GroundCell& cell, const GridRing& ring) {
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const geo::GridPosition& a = ring[i];
        const geo::GridPosition& b = ring[i + 1 < ring.size() ? i + 1 : 0];
        const Edge edge{a.column, a.row, b.column, b.row};
        if (a.row == b.row) continue;
        for (const Node& node : kThree) {
            const double v = edge.v0 + node.at * (edge.v1 - edge.v0);
            area += node.weight * (edge.v1 - edge.v0) * edge.u(v) * parabola(cell.column_m, v) *
                    parabola(cell.row_m, v);
        }
    }
    return area;
}

}  // namespace relevo::lod
