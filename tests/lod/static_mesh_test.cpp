// Static meshes against brute force: every triangle over every post in long double, every edge counted, and
// the coarsest mesh found anew by a slow search that shares no code with the quick one.

#include "lod/static_mesh/static_mesh.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

using lod::GridPoint;
using lod::PostTriangle;
using lod::StaticMesh;
using Heights = lod::Raster<float>;

Heights heights_of(int columns, int rows, const std::function<double(int, int)>& height) {
    Heights heights(columns, rows);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            heights.at(column, row) = static_cast<float>(height(column, row));
    return heights;
}

std::vector<PostTriangle> triangles_of(const StaticMesh& mesh) {
    std::vector<PostTriangle> all;
    for (std::size_t i = 0; i < mesh.batches(); ++i) mesh.append_batch(i, all);
    return all;
}

bool is_ground(const Heights& heights, int column, int row) {
    if (column < 0 || row < 0 || column + 1 >= heights.columns() || row + 1 >= heights.rows()) return false;
    for (const int x : {column, column + 1})
        for (const int y : {row, row + 1})
            if (std::isnan(heights.at(x, y))) return false;
    return true;
}

/// A triangle's plane against a post, by barycentric weights in long double: without rounding for heights in
/// whole parts of a metre.
struct Flat {
    const PostTriangle& t;
    const Heights& heights;

    static long double area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
        const long double ux = b.column - a.column;
        const long double uy = a.row - b.row;  // north
        const long double vx = c.column - a.column;
        const long double vy = a.row - c.row;
        return ux * vy - uy * vx;
    }
    /// False outside the triangle.
    bool at(const GridPoint& p, long double& error) const {
        const long double whole = area(t[0], t[1], t[2]);
        error = -whole * static_cast<long double>(heights.at(p.column, p.row));
        for (std::size_t i = 0; i < 3; ++i) {
            const long double weight = area(p, t[(i + 1) % 3], t[(i + 2) % 3]);
            if (weight < 0) return false;
            error += weight * static_cast<long double>(heights.at(t[i].column, t[i].row));
        }
        error = std::abs(error / whole);
        return true;
    }
};

struct Brute {
    long double max_m = 0;
    long double rms_m = 0;
    std::uint64_t posts = 0;
};

/// Every post against all triangles around it, which have to agree.
Brute brute_error(const std::vector<PostTriangle>& triangles, const Heights& heights) {
    std::map<std::pair<int, int>, long double> errors;
    for (const PostTriangle& t : triangles) {
        const auto [west, east] = std::minmax({t[0].column, t[1].column, t[2].column});
        const auto [north, south] = std::minmax({t[0].row, t[1].row, t[2].row});
        for (int row = north; row <= south; ++row) {
            for (int column = west; column <= east; ++column) {
                long double error = 0;
                if (!Flat{t, heights}.at({column, row}, error)) continue;
                const auto [known, fresh] = errors.emplace(std::pair(column, row), error);
                EXPECT_NEAR(static_cast<double>(known->second), static_cast<double>(error), 1e-12)
                    << "a crack at " << column << ", " << row;
            }
        }
    }
    Brute brute;
    long double squares = 0;
    for (const auto& [post, error] : errors) {
        brute.max_m = std::max(brute.max_m, error);
        squares += error * error;
    }
    brute.posts = errors.size();
    if (brute.posts > 0) brute.rms_m = std::sqrt(squares / static_cast<long double>(brute.posts));
    return brute;
}

/// Triangles face up; every edge is used once in each direction, or once with ground on one side alone;
/// together they are as large as the ground.
void expect_watertight(const std::vector<PostTriangle>& triangles, const Heights& heights) {
    using Edge = std::tuple<int, int, int, int>;
    std::set<Edge> edges;
    long double area = 0;
    for (const PostTriangle& t : triangles) {
        const long double doubled = Flat::area(t[0], t[1], t[2]);
        ASSERT_GT(doubled, 0) << "faces down";
        area += doubled / 2;
        for (std::size_t i = 0; i < 3; ++i) {
            const GridPoint& a = t[i];
            const GridPoint& b = t[(i + 1) % 3];
            ASSERT_TRUE(edges.insert({a.column, a.row, b.column, b.row}).second) << "an edge is used twice";
        }
    }
    std::uint64_t ground = 0;
    for (int row = 0; row + 1 < heights.rows(); ++row)
        for (int column = 0; column + 1 < heights.columns(); ++column)
            ground += is_ground(heights, column, row);
    ASSERT_EQ(area, static_cast<long double>(ground));
    for (const auto& [x1, y1, x2, y2] : edges) {
        if (edges.contains({x2, y2, x1, y1})) continue;
        ASSERT_TRUE(x1 == x2 || y1 == y2) << "a border along a diagonal";
        const int dx = (x2 > x1) - (x2 < x1);
        const int dy = (y2 > y1) - (y2 < y1);
        // Seen along the edge the triangle is on the left; the cells on the right must be none.
        for (int x = x1, y = y1; x != x2 || y != y2; x += dx, y += dy) {
            const int column = dx > 0 ? x : dx < 0 ? x - 1 : dy > 0 ? x - 1 : x;
            const int row = dy > 0 ? y : dy < 0 ? y - 1 : dx > 0 ? y : y - 1;
            ASSERT_FALSE(is_ground(heights, column, row)) << "a gap at " << x << ", " << y;
        }
    }
}

struct Ground {
    const char* name;
    int columns;
    int rows;
    std::function<double(int, int)> height;
};

double with_voids(int column, int row) {
    const bool hole = (column > 10 && column < 15 && row > 3 && row < 9) || (column == 25 && row == 20) ||
                      row + 2 * column == 75;
    return hole ? std::nan("") : mountains(column, row);
}

std::vector<Ground> grounds() {
    const auto plane = [](int x, int y) { return 100 + 3 * x - 7 * y; };
    const auto spike = [](int x, int y) { return x == 21 && y == 13 ? 8000.0 : 0.0; };
    const auto cliff = [](int x, int) { return x < 17 ? 0.0 : 1000.0; };
    const auto rough = [](int x, int y) { return 500 * noise(x, y); };
    return {
        {"flat", 33, 33, [](int, int) { return 12.5; }},
        {"plane", 33, 33, plane},
        {"plane 2^n+2", 34, 34, plane},
        {"spike", 33, 33, spike},
        {"cliff", 65, 33, cliff},
        {"noise", 33, 33, rough},
        {"noise 2^n+2", 34, 34, rough},
        {"mountains", 65, 65, mountains},
        {"mountains, odd sides", 59, 43, mountains},
        {"mountains, long", 150, 9, mountains},
        {"mountains, tall", 4, 97, mountains},
        {"mountains, 2 rows", 50, 2, mountains},
        {"voids", 50, 41, with_voids},
        {"voids in the plane", 50, 41,
         [=](int x, int y) { return std::isnan(with_voids(x, y)) ? std::nan("") : plane(x, y); }},
        {"half void", 65, 65, [](int x, int y) { return y < 32 ? std::nan("") : mountains(x, y); }},
        {"chess board of voids", 20, 20,
         [](int x, int y) { return (x + y) % 5 == 0 ? std::nan("") : 1.0 * x; }},
        {"2 x 2", 2, 2, rough},
        {"3 x 3", 3, 3, rough},
        {"3 x 2", 3, 2, rough},
    };
}

TEST(StaticMesh, KeepsItsErrorAndIsWatertightOnAnyGround) {
    for (const Ground& ground : grounds()) {
        const Heights heights = heights_of(ground.columns, ground.rows, ground.height);
        const lod::HeightSurface surface(heights);
        std::uint64_t finer = std::numeric_limits<std::uint64_t>::max();
        for (const double max_error : {0.0, 0.5, 3.0, 20.0, 120.0, 5000.0}) {
            SCOPED_TRACE(std::string(ground.name) + ", " + std::to_string(max_error) + " m");
            const StaticMesh mesh = StaticMesh::build(surface, max_error);
            const auto triangles = triangles_of(mesh);
            EXPECT_EQ(triangles.size(), mesh.triangles());
            EXPECT_GT(triangles.size(), 0u);
            expect_watertight(triangles, heights);
            const Brute brute = brute_error(triangles, heights);
            EXPECT_LE(brute.max_m, static_cast<long double>(max_error));
            const lod::MeshError measured = mesh.measure(surface);
            EXPECT_EQ(measured.posts, brute.posts);
            EXPECT_EQ(measured.posts, mesh.posts_to_cover());
            EXPECT_NEAR(measured.max_m, static_cast<double>(brute.max_m), 1e-12);
            EXPECT_NEAR(measured.rms_m, static_cast<double>(brute.rms_m), 1e-12);
            EXPECT_LE(triangles.size(), finer) << "more triangles for a larger error";
            finer = triangles.size();
        }
    }
}

TEST(StaticMesh, NumbersVerticesRowByRow) {
    const Heights heights = heights_of(50, 41, with_voids);
    const StaticMesh mesh = StaticMesh::build(lod::HeightSurface(heights), 20);
    std::set<std::pair<int, int>> used;  // row before column
    for (const PostTriangle& t : triangles_of(mesh))
        for (const GridPoint& p : t) used.insert({p.row, p.column});
    EXPECT_EQ(mesh.vertices(), used.size());
    std::uint32_t number = 0;
    for (const auto& [row, column] : used) EXPECT_EQ(mesh.number({column, row}), number++);
}

TEST(StaticMesh, WithoutErrorTakesEveryPostButThoseInAPlane) {
    const Heights noisy = heights_of(34, 27, [](int x, int y) { return noise(x, y); });
    const StaticMesh all = StaticMesh::build(lod::HeightSurface(noisy), 0);
    EXPECT_EQ(all.vertices(), 34u * 27);
    EXPECT_EQ(all.triangles(), 2u * 33 * 26);

    // A plane of heights that floats hold takes two triangles, and at odd sizes those that the border cuts.
    const auto plane = [](int x, int y) { return 0.25 * x - 1.5 * y; };
    const Heights square = heights_of(129, 129, plane);
    EXPECT_EQ(StaticMesh::build(lod::HeightSurface(square), 0).triangles(), 2u);
    const Heights odd = heights_of(131, 131, plane);
    EXPECT_LE(StaticMesh::build(lod::HeightSurface(odd), 0).triangles(), 4u);
}

TEST(StaticMesh, NothingToCoverIsAnEmptyMesh) {
    const auto one_post = [](int x, int y) { return x == 3 && y == 4 ? 7.0 : std::nan(""); };
    for (const Heights& heights :
         {heights_of(9, 9, one_post), heights_of(1, 40, mountains), heights_of(40, 1, mountains),
          heights_of(9, 9, [](int, int) { return std::nan(""); })}) {
        const lod::HeightSurface surface(heights);
        const StaticMesh mesh = StaticMesh::build(surface, 1);
        EXPECT_EQ(mesh.triangles(), 0u);
        EXPECT_EQ(mesh.vertices(), 0u);
        EXPECT_EQ(mesh.measure(surface).posts, 0u);
    }
}

// --- The coarsest mesh, found slowly: triangles as they come from soar/diamond.hpp's definition of a vertex,
// split until all fit, each error a scan in long double.

class SlowBisection {
  public:
    SlowBisection(const Heights& heights, int levels, long double max_error)
        : heights_(heights), levels_(levels), max_error_(max_error) {
        bool changed = true;
        while (changed) {
            changed = false;
            for (const auto& [triangle, level] : leaves()) {
                if (level == 2 * levels || fits(triangle)) continue;
                add(lod::midpoint(triangle[0], triangle[1]), level);
                changed = true;
            }
        }
    }
    std::size_t triangles() const { return leaves().size(); }

  private:
    /// With the level of the vertex that would split them.
    std::vector<std::pair<PostTriangle, int>> leaves() const {
        const int side = 1 << levels_;
        std::vector<std::pair<PostTriangle, int>> open{{{{{0, 0}, {side, side}, {0, side}}}, 0},
                                                       {{{{0, 0}, {side, side}, {side, 0}}}, 0}};
        std::vector<std::pair<PostTriangle, int>> found;
        while (!open.empty()) {
            const auto [t, level] = open.back();
            open.pop_back();
            const GridPoint middle = lod::midpoint(t[0], t[1]);
            if (level == 2 * levels_ || !splits_.contains({middle.column, middle.row})) {
                found.emplace_back(t, level);
                continue;
            }
            open.push_back({{t[0], t[2], middle}, level + 1});
            open.push_back({{t[2], t[1], middle}, level + 1});
        }
        return found;
    }

    void add(const GridPoint& post, int level) {
        if (!splits_.insert({post.column, post.row}).second || level == 0) return;
        for (const GridPoint& parent : lod::diamond(post, level, levels_).apexes) add(parent, level - 1);
    }

    bool fits(PostTriangle t) const {
        if (Flat::area(t[0], t[1], t[2]) < 0) std::swap(t[0], t[1]);
        const auto [west, east] = std::minmax({t[0].column, t[1].column, t[2].column});
        const auto [north, south] = std::minmax({t[0].row, t[1].row, t[2].row});
        for (int row = north; row <= south; ++row) {
            for (int column = west; column <= east; ++column) {
                long double error = 0;
                if (Flat{t, heights_}.at({column, row}, error) && error > max_error_) return false;
            }
        }
        return true;
    }

    const Heights& heights_;
    int levels_;
    long double max_error_;
    std::set<std::pair<int, int>> splits_;
};

TEST(StaticMesh, IsTheCoarsestOfItsKind) {
    for (const auto& ground : grounds()) {
        if (ground.columns != 33 || ground.rows != 33) continue;
        const Heights heights = heights_of(33, 33, ground.height);
        for (const double max_error : {0.0, 2.0, 30.0, 400.0}) {
            const SlowBisection slow(heights, 5, static_cast<long double>(max_error));
            EXPECT_EQ(StaticMesh::build(lod::HeightSurface(heights), max_error).triangles(), slow.triangles())
                << ground.name << ", " << max_error << " m";
        }
    }
}

TEST(StaticMesh, DoesNotDependOnThreads) {
    const Heights heights = heights_of(400, 300, [](int x, int y) {
        return (x - 200) * (x - 200) + (y - 150) * (y - 150) < 900 ? std::nan("") : mountains(x, y);
    });
    const lod::HeightSurface surface(heights);
    const auto make = [&] {
        const StaticMesh mesh = StaticMesh::build(surface, 8);
        return std::pair(triangles_of(mesh), mesh.measure(surface).rms_m);
    };
    const auto many = make();
    std::pair<std::vector<PostTriangle>, double> one;
    tbb::task_arena(1).execute([&] { one = make(); });
    EXPECT_EQ(one.second, many.second);
    ASSERT_EQ(one.first.size(), many.first.size());
    EXPECT_TRUE(one.first == many.first);
}

/// A triangle of a large grid is scanned on all threads: the one post that is off must be found in it.
TEST(StaticMesh, FindsOnePostInAVeryLargeTriangle) {
    Heights heights(2049, 2049, 5.0F);
    EXPECT_EQ(StaticMesh::build(lod::HeightSurface(heights), 0.5).triangles(), 2u);
    heights.at(1717, 291) = 6;
    const lod::HeightSurface surface(heights);
    const StaticMesh mesh = StaticMesh::build(surface, 0.5);
    EXPECT_GT(mesh.triangles(), 2u);
    EXPECT_LE(mesh.measure(surface).max_m, 0.5);
}

// --- In space

/// The distance between a triangle and the ground at the same place of the grid, positions by GeographicLib.
double brute_space_error(const std::vector<PostTriangle>& triangles, const Heights& heights,
                         const geo::GridFrame& frame) {
    const auto position = [&](const GridPoint& p) {
        return frame
            .ecef({static_cast<double>(p.column), static_cast<double>(p.row)},
                  geo::EllipsoidalHeight{static_cast<double>(heights.at(p.column, p.row))})
            .m;
    };
    double worst = 0;
    for (const PostTriangle& t : triangles) {
        const auto [west, east] = std::minmax({t[0].column, t[1].column, t[2].column});
        const auto [north, south] = std::minmax({t[0].row, t[1].row, t[2].row});
        const long double whole = Flat::area(t[0], t[1], t[2]);
        for (int row = north; row <= south; ++row) {
            for (int column = west; column <= east; ++column) {
                const GridPoint p{column, row};
                const auto u = static_cast<double>(Flat::area(p, t[1], t[2]) / whole);
                const auto v = static_cast<double>(Flat::area(p, t[2], t[0]) / whole);
                const auto w = static_cast<double>(Flat::area(p, t[0], t[1]) / whole);
                if (u < 0 || v < 0 || w < 0) continue;
                const glm::dvec3 drawn = u * position(t[0]) + v * position(t[1]) + w * position(t[2]);
                worst = std::max(worst, glm::length(drawn - position(p)));
            }
        }
    }
    return worst;
}

TEST(StaticMesh, InSpaceAFlatPlainIsRound) {
    for (const auto& frame : {geographic_frame(130, 101, 47, 10, 0.01),
                              polar_frame(geo::FrameKind::ups_north, 130, 101, 1000, 20000, -30000)}) {
        const Heights flat(frame.columns, frame.rows, 0.0F);
        EXPECT_LE(StaticMesh::build(lod::HeightSurface(flat), 1).triangles(), 5u);
        const lod::SpaceSurface surface(flat, frame, {}, 0, 0);
        const StaticMesh mesh = StaticMesh::build(surface, 1);
        EXPECT_GT(mesh.triangles(), 100u);  // an edge of 10 km sags 2 m
        const double worst = brute_space_error(triangles_of(mesh), flat, frame);
        EXPECT_LE(worst, 1);
        EXPECT_NEAR(mesh.measure(surface).max_m, worst, 1e-7);
    }
}

TEST(StaticMesh, InSpaceMountainsKeepTheirError) {
    const auto frame = geographic_frame(75, 60, 47, 10, 0.002);
    const Heights heights = heights_of(75, 60, mountains);
    const lod::SpaceSurface surface(heights, frame, {}, 0, 0);
    for (const double max_error : {0.0, 5.0, 100.0}) {
        const StaticMesh mesh = StaticMesh::build(surface, max_error);
        const auto triangles = triangles_of(mesh);
        expect_watertight(triangles, heights);
        const double worst = brute_space_error(triangles, heights, frame);
        EXPECT_LE(worst, max_error + 2e-8);  // two ways to compute positions, each to 10 nm
        EXPECT_LE(mesh.measure(surface).max_m, max_error);
    }
}

/// A box of a scene is where the scene has it.
TEST(StaticMesh, InSpaceABoxIsWhereTheSceneHasIt) {
    const auto frame = geographic_frame(75, 60, 47, 10, 0.002);
    const Heights box = heights_of(20, 10, [](int x, int y) { return mountains(x + 31, y + 17); });
    const lod::SpaceSurface surface(box, frame, {}, 31, 17);
    const auto there =
        frame.ecef({31 + 4.0, 17 + 6.0}, geo::EllipsoidalHeight{static_cast<double>(box.at(4, 6))});
    EXPECT_LT(glm::length(surface.position(4, 6) - there.m), 1e-8);
}

}  // namespace
}  // namespace relevo::test
