#include "lod/soar/vertex_lanes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lod/machine_clones.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/soar/fine_metrics.hpp"
#include "lod/soar/four.hpp"

// The loops below are left to the compiler to vectorise, but for the longest one. CMake compiles this file
// without errno and floating point traps, which change no result. Nothing here fuses a product and a sum, so
// that results are the same bits everywhere.
#define RELEVO_LANES RELEVO_CLONES("avx2", "default")

namespace relevo::lod {

namespace {

/// The smallest value with a code that is not below; as encode_up.
inline float rounded_up(double value) {
    constexpr std::uint32_t kDropped = (1u << (23 - kCodeMantissaBits)) - 1;
    const float nearest = static_cast<float>(value);
    const std::uint32_t low = static_cast<double>(nearest) < value ? kDropped + 1 : kDropped;
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(nearest) + low) & ~kDropped);
}

inline float error_from(double m2) {
    const double m = std::sqrt(m2 > 0 ? m2 : 0.0);  // NaN: no post
    return rounded_up(m < kNegligibleM ? 0.0 : m);
}

inline double larger(double a, double b) {
    return a > b ? a : b;  // b where a is NaN
}

inline double distance2(const Lanes& a, const Lanes& b, int k) {
    const double dx = a.x[k] - b.x[k];
    const double dy = a.y[k] - b.y[k];
    const double dz = a.z[k] - b.z[k];
    return dx * dx + dy * dy + dz * dz;
}

inline double surplus2_at(const Lanes& here, const Lanes& left, const Lanes& right, int k) {
    const double dx = here.x[k] - 0.5 * (left.x[k] + right.x[k]);
    const double dy = here.y[k] - 0.5 * (left.y[k] + right.y[k]);
    const double dz = here.z[k] - 0.5 * (left.z[k] + right.z[k]);
    return dx * dx + dy * dy + dz * dz;
}

struct Fours {
    Four x, y, z;
};

inline Fours load(const Lanes& posts, std::ptrdiff_t at) {
    return {*reinterpret_cast<const FourDoubles*>(posts.x + at),
            *reinterpret_cast<const FourDoubles*>(posts.y + at),
            *reinterpret_cast<const FourDoubles*>(posts.z + at)};
}
inline Fours operator-(const Fours& a, const Fours& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Fours operator+(const Fours& a, const Fours& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Fours operator*(double s, const Fours& a) {
    return {s * a.x, s * a.y, s * a.z};
}

/// Joins what posts are off that should be at start, start + step, ...
inline void join_run(const Lanes& posts, const double* hole, std::ptrdiff_t row, const std::ptrdiff_t* column,
                     int count, const Fours& start, const Fours& step, Four& most) {
    for (int i = 0; i < count; ++i) {
        const Fours d = start + static_cast<double>(i) * step - load(posts, row + column[i]);
        Four m2 = d.x * d.x + d.y * d.y + d.z * d.z;
        if (hole) m2 += *reinterpret_cast<const FourDoubles*>(hole + row + column[i]);
        most = m2 > most ? m2 : most;
    }
}

[[RELEVO_LANES]] void scan(const std::array<DiamondPosts::Triangle, 2>& triangles, int steps,
                           const Lanes& posts, const double* hole, const DiamondPosts::Offsets& offsets,
                           int lanes, double* m2) {
    constexpr auto reach = static_cast<std::size_t>(DiamondPosts::kReach);
    const auto row_of = [&](int row) { return offsets.row[static_cast<std::size_t>(row) + reach]; };
    const auto column_of = [&](int column) {
        return &offsets.column[static_cast<std::size_t>(column) + reach];
    };
    for (int k = 0; k < lanes; k += 4) {
        Four most = {-1, -1, -1, -1};
        const auto corner = [&](const GridPoint& p) {
            return load(posts, row_of(p.row) + *column_of(p.column) + k);
        };
        for (const DiamondPosts::Triangle& t : triangles) {
            const Fours origin = corner(t.corner[0]);
            const Fours p1 = corner(t.corner[1]) - origin;
            const Fours p2 = corner(t.corner[2]) - origin;
            const Fours along = t.along[0] * p1 + t.along[1] * p2;
            const Fours down = t.down[0] * p1 + t.down[1] * p2;
            for (const DiamondPosts::Run& run : t.runs) {
                const Fours start = origin + static_cast<double>(run.row - t.corner[0].row) * down +
                                    static_cast<double>(run.first - t.corner[0].column) * along;
                join_run(posts, hole, row_of(run.row) + k, column_of(run.first), run.last - run.first + 1,
                         start, along, most);
            }
        }
        // The edge, which both triangles share and one of them may lack at the grid's border.
        const GridPoint& left = triangles[0].corner[0];
        const GridPoint& right = triangles[0].corner[1];
        const int dx = (right.column - left.column) / steps;
        const int dy = (right.row - left.row) / steps;
        const Fours first = corner(left);
        const Fours step = (1.0 / steps) * (corner(right) - first);
        for (int i = 1; i < steps; ++i) {
            const Fours start = first + static_cast<double>(i) * step;
            join_run(posts, hole, row_of(left.row + i * dy) + k, column_of(left.column + i * dx), 1, start,
                     step, most);
        }
        *reinterpret_cast<FourDoubles*>(m2 + k) = most;
    }
}

[[RELEVO_LANES]] void last_level(Lanes here, Lanes a, Lanes b, Lanes c, Lanes d, int lanes, float* error,
                                 float* radius) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) {
        double reach2 = larger(distance2(here, a, k), -1);
        reach2 = larger(distance2(here, b, k), reach2);
        reach2 = larger(distance2(here, c, k), reach2);
        reach2 = larger(distance2(here, d, k), reach2);
        error[k] = error_from(surplus2_at(here, a, b, k));
        // Without a place, no corner is near.
        const float reach = rounded_up(std::sqrt(larger(reach2, 0)) + kRadiusMarginM);
        radius[k] = reach2 >= 0 ? reach : 0.0f;
    }
}

[[RELEVO_LANES]] void drop_holes(const double* here, const double* a, const double* b, const double* c,
                                 const double* d, int lanes, float* error, float* radius) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) {
        error[k] = here[k] == 0 ? error[k] : 0.0f;
        const bool any = (here[k] == 0) | (a[k] == 0) | (b[k] == 0) | (c[k] == 0) | (d[k] == 0);
        radius[k] = any ? radius[k] : 0.0f;
    }
}

[[RELEVO_LANES]] void join_reach(Lanes here, Lanes child, const float* child_radius, int lanes,
                                 double* reach) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) {
        const double radius = static_cast<double>(child_radius[k]);
        const double far = std::sqrt(distance2(here, child, k)) + radius;
        reach[k] = larger(radius > 0 ? far : -1.0, reach[k]);
    }
}

[[RELEVO_LANES]] void join_corner(Lanes here, Lanes corner, int lanes, double* reach) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) {
        const double far = larger(std::sqrt(distance2(here, corner, k)), reach[k]);
        reach[k] = reach[k] >= 0 ? far : reach[k];
    }
}

[[RELEVO_LANES]] void finish_radius(const double* reach, int lanes, float* radius) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) {
        const float up = rounded_up(reach[k] + kRadiusMarginM);
        radius[k] = reach[k] >= 0 ? up : 0.0f;
    }
}

[[RELEVO_LANES]] void surplus(Lanes here, Lanes left, Lanes right, int lanes, double* m2) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) m2[k] = surplus2_at(here, left, right, k);
}

[[RELEVO_LANES]] void add(const double* hole, int lanes, double* m2) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) m2[k] += hole[k];
}

[[RELEVO_LANES]] void join_errors(const double* own_m2, const float* a, const float* b, const float* c,
                                  const float* d, const float* radius, int lanes, float* error) {
#pragma GCC ivdep
    for (int k = 0; k < lanes; ++k) {
        const float ab = a[k] > b[k] ? a[k] : b[k];
        const float cd = c[k] > d[k] ? c[k] : d[k];
        const float below = ab > cd ? ab : cd;
        const float own = error_from(own_m2[k]);
        const float larger_one = own > below ? own : below;
        error[k] = radius[k] > 0 ? larger_one : 0.0f;
    }
}

DiamondPosts::Triangle triangle_posts(const GridPoint& left, const GridPoint& right, const GridPoint& apex) {
    DiamondPosts::Triangle t{{left, right, apex}, {}, {}, {}};
    const GridPoint first{right.column - left.column, right.row - left.row};
    const GridPoint second{apex.column - left.column, apex.row - left.row};
    const double area = first.column * second.row - second.column * first.row;
    t.along = {second.row / area, -first.row / area};
    t.down = {-second.column / area, first.column / area};
    const auto inside = [&](const GridPoint& p) {
        const double u = t.along[0] * (p.column - left.column) + t.down[0] * (p.row - left.row);
        const double w = t.along[1] * (p.column - left.column) + t.down[1] * (p.row - left.row);
        return u > 0 && w > 0 && u + w < 1;
    };
    for (int row = -DiamondPosts::kReach; row <= DiamondPosts::kReach; ++row) {
        DiamondPosts::Run run{row, 1, 0};
        for (int column = -DiamondPosts::kReach; column <= DiamondPosts::kReach; ++column) {
            if (!inside({column, row})) continue;
            if (run.last < run.first) run.first = column;
            run.last = column;
        }
        if (run.first <= run.last) t.runs.push_back(run);
    }
    return t;
}

}  // namespace

DiamondShape diamond_shape(const GridPoint& vertex, int level, int s) {
    if (level % 2 == 0) {
        const auto coarse_end = [s](int centre) { return (centre - s) % (4 * s) == 0 ? -s : s; };
        const int x = coarse_end(vertex.column);
        const int y = coarse_end(vertex.row);
        return {{x, y}, {-x, -y}, {{{x, -y}, {-x, y}}}, {{{-s, 0}, {s, 0}, {0, -s}, {0, s}}}};
    }
    const bool along_row = vertex.row % (2 * s) == 0;
    const int x = along_row ? s : 0;
    const int y = along_row ? 0 : s;
    const int h = s / 2;
    return {{-x, -y}, {x, y}, {{{-y, -x}, {y, x}}}, {{{-h, -h}, {h, -h}, {-h, h}, {h, h}}}};
}

DiamondPosts::DiamondPosts(const DiamondShape& shape, int s) : steps_(2 * s) {
    for (std::size_t i = 0; i < 2; ++i)
        triangles_[i] = triangle_posts(shape.left, shape.right, shape.apexes[i]);
}

void DiamondPosts::deviation2(const Lanes& posts, const double* hole, const Offsets& offsets, int lanes,
                              double* m2) const {
    scan(triangles_, steps_, posts, hole, offsets, lanes, m2);
}

const DiamondPosts& diamond_posts(const GridPoint& vertex, int level, int s) {
    // By s, parity of the level and which of the squares around the vertex this is.
    using OfSize = std::array<DiamondPosts, 8>;
    static const auto all = [] {
        std::array<OfSize, DiamondPosts::kReach + 1> made;
        for (int size = 2; size <= DiamondPosts::kReach; size *= 2) {
            for (int way = 0; way < 4; ++way) {
                const GridPoint centre{size * (2 * (way % 2) + 1), size * (2 * (way / 2) + 1)};
                const GridPoint middle{size * (way % 2), size * (1 - way % 2)};
                OfSize& of = made[static_cast<std::size_t>(size)];
                of[static_cast<std::size_t>(way)] = {diamond_shape(centre, 0, size), size};
                of[static_cast<std::size_t>(4 + way)] = {diamond_shape(middle, 1, size), size};
            }
        }
        return made;
    }();
    const int across = level % 2 == 0 ? 2 * s : s;
    const auto odd = [across](int value) { return ((value / across) & 1) != 0; };
    const bool column_is_odd = level % 2 == 0 ? odd(vertex.column - s) : odd(vertex.column);
    const bool row_is_odd = level % 2 == 0 && odd(vertex.row - s);
    const int way = (column_is_odd ? 1 : 0) + (row_is_odd ? 2 : 0) + (level % 2 == 0 ? 0 : 4);
    return all[static_cast<std::size_t>(s)][static_cast<std::size_t>(way)];
}

void finish_last_level(const Lanes& here, const std::array<Lanes, 4>& corners,
                       const std::array<const double*, 5>* holes, int lanes, float* error, float* radius) {
    last_level(here, corners[0], corners[1], corners[2], corners[3], lanes, error, radius);
    if (!holes) return;
    const std::array<const double*, 5>& h = *holes;
    drop_holes(h[0], h[1], h[2], h[3], h[4], lanes, error, radius);
}

void nest_radius(const Lanes& here, const std::array<Lanes, 4>& children,
                 const std::array<const float*, 4>& child_radii, const std::array<Lanes, 4>* corners,
                 int lanes, float* radius) {
    std::array<double, kMostLanes> reach;
    std::fill_n(reach.begin(), lanes, -1.0);
    for (std::size_t i = 0; i < 4; ++i) join_reach(here, children[i], child_radii[i], lanes, reach.data());
    if (corners) {
        for (const Lanes& corner : *corners) join_corner(here, corner, lanes, reach.data());
    }
    finish_radius(reach.data(), lanes, radius);
}

void surplus2(const Lanes& here, const Lanes& left, const Lanes& right, const double* hole, int lanes,
              double* m2) {
    surplus(here, left, right, lanes, m2);
    if (hole) add(hole, lanes, m2);
}

void nest_error(const double* own_m2, const std::array<const float*, 4>& child_errors, const float* radius,
                int lanes, float* error) {
    join_errors(own_m2, child_errors[0], child_errors[1], child_errors[2], child_errors[3], radius, lanes,
                error);
}

}  // namespace relevo::lod
