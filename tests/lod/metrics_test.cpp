#include "lod/soar/metrics.hpp"

#include <array>
#include <cmath>
#include <map>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/mesh_heights.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/soar/diamond.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

TEST(MetricCode, RoundsUpByLittleAndSorts) {
    std::uint16_t before = 0;
    for (double value = 1e-9; value < 1e7; value *= 1.0007) {
        const std::uint16_t code = encode_up(value);
        EXPECT_GE(static_cast<double>(decode(code)), value);
        EXPECT_LE(static_cast<double>(decode(code)), value * kCodeStep);
        EXPECT_GE(code, before);
        before = code;
    }
    EXPECT_EQ(encode_up(0), 0);
    EXPECT_EQ(decode(0), 0.0f);
    EXPECT_EQ(static_cast<double>(decode(encode_up(256))), 256) << "what has a code keeps its value";
}

/// The definitions word by word, slowly: ECEF by GridFrame's exact path, every post tried against both
/// triangles, and nesting over explicit sets of descendants.
class BruteForce {
  public:
    BruteForce(const geo::GridFrame& frame, const Raster<float>& heights)
        : frame_(frame), n_(frame.levels()), heights_(heights), mesh_(mesh_heights(frame, heights)) {}

    glm::dvec3 position(const GridPoint& p) const {
        return frame_
            .ecef({static_cast<double>(p.column), static_cast<double>(p.row)},
                  {static_cast<double>(mesh_.at(p.column, p.row))})
            .m;
    }
    bool is_valid(const GridPoint& p) const {
        return p.column < frame_.columns && p.row < frame_.rows && !std::isnan(heights_.at(p.column, p.row));
    }

    struct Own {
        double bounded = 0;
        double incremental = 0;
        double reach = 0;  // to the farthest valid post or corner of the diamond
        bool any = false;
    };

    Own own(const GridPoint& v, int level) const {
        const Diamond d = diamond(v, level, n_);
        Own result;
        const glm::dvec3 here = position(v);
        if (is_valid(v)) {
            result.incremental = glm::distance(here, 0.5 * (position(d.left) + position(d.right)));
        }
        for (const GridPoint& corner : {d.left, d.right}) {
            result.reach = std::max(result.reach, glm::distance(here, position(corner)));
        }
        for (const GridPoint& apex : d.apexes) {
            result.reach = std::max(result.reach, glm::distance(here, position(apex)));
            const std::array<GridPoint, 3> t{d.left, d.right, apex};
            for (int row = 0; row < frame_.rows; ++row) {
                for (int column = 0; column < frame_.columns; ++column) {
                    const GridPoint x{column, row};
                    const auto w = weights(t, x);
                    if (w[0] < -1e-12 || w[1] < -1e-12 || w[2] < -1e-12 || !is_valid(x)) continue;
                    result.any = true;
                    const glm::dvec3 drawn =
                        w[0] * position(t[0]) + w[1] * position(t[1]) + w[2] * position(t[2]);
                    result.bounded = std::max(result.bounded, glm::distance(drawn, position(x)));
                    result.reach = std::max(result.reach, glm::distance(here, position(x)));
                }
            }
        }
        return result;
    }

  private:
    static std::array<double, 3> weights(const std::array<GridPoint, 3>& t, const GridPoint& x) {
        const auto area = [](const GridPoint& a, const GridPoint& b, const GridPoint& c) {
            return static_cast<double>((b.column - a.column) * (c.row - a.row) -
                                       (b.row - a.row) * (c.column - a.column));
        };
        const double all = area(t[0], t[1], t[2]);
        return {area(t[1], t[2], x) / all, area(t[2], t[0], x) / all, area(t[0], t[1], x) / all};
    }

    const geo::GridFrame& frame_;
    int n_;
    const Raster<float>& heights_;
    Raster<float> mesh_;
};

void expect_metrics_as_defined(const geo::GridFrame& frame, const Raster<float>& heights) {
    const int n = frame.levels();
    const MetricRasters metrics = build_metrics(frame, {}, heights);
    const BruteForce brute(frame, heights);
    std::map<std::pair<int, int>, BruteForce::Own> nested;
    for (int level = 2 * n - 1; level >= 0; --level) {
        for (int row = 0; row < frame.padded_side(); ++row) {
            for_each_vertex_in_row(n, level, row, [&](const GridPoint& v) {
                BruteForce::Own truth = brute.own(v, level);
                const double radius = static_cast<double>(decode(metrics.radius.at(v.column, v.row)));
                for (const GridPoint& c : children(v, level, n)) {
                    const BruteForce::Own& below = nested[{c.column, c.row}];
                    truth.bounded = std::max(truth.bounded, below.bounded);
                    truth.incremental = std::max(truth.incremental, below.incremental);
                    truth.any = truth.any || below.any;
                    if (below.any) {
                        const double child_radius =
                            static_cast<double>(decode(metrics.radius.at(c.column, c.row)));
                        EXPECT_GE(radius, glm::distance(brute.position(v), brute.position(c)) + child_radius);
                    }
                }
                nested[{v.column, v.row}] = truth;
                const double bounded = static_cast<double>(decode(metrics.bounded.at(v.column, v.row)));
                const double incremental =
                    static_cast<double>(decode(metrics.incremental.at(v.column, v.row)));
                EXPECT_EQ(radius > 0, truth.any) << v.column << ' ' << v.row;
                if (!truth.any) return;
                EXPECT_GE(bounded, truth.bounded - 1e-8) << v.column << ' ' << v.row;
                EXPECT_LE(bounded, truth.bounded * kCodeStep + 1e-8) << v.column << ' ' << v.row;
                EXPECT_GE(incremental, truth.incremental - 1e-8);
                EXPECT_LE(incremental, truth.incremental * kCodeStep + 1e-8);
                EXPECT_GE(radius, truth.reach);
            });
        }
    }
}

TEST(Metrics, AreTheirDefinitionOnMountains) {
    const auto frame = test::geographic_frame(33, 33);
    expect_metrics_as_defined(frame, test::make_heights(frame, test::mountains));
}

TEST(Metrics, AreTheirDefinitionAboveTheLattice) {
    const auto frame = test::geographic_frame(60, 65);
    expect_metrics_as_defined(frame, test::make_heights(frame, test::mountains));
}

TEST(Metrics, AreTheirDefinitionWithPadding) {
    for (const auto& [columns, rows] : {std::pair{18, 18}, {20, 9}, {3, 17}, {2, 2}, {1, 5}, {1, 1}}) {
        const auto frame = test::geographic_frame(columns, rows, 60);
        expect_metrics_as_defined(frame, test::make_heights(frame, test::mountains));
    }
}

TEST(Metrics, AreTheirDefinitionWithVoids) {
    const auto frame = test::geographic_frame(33, 25);
    expect_metrics_as_defined(frame, test::make_heights(frame, [](int column, int row) {
                                  const bool hole = std::hypot(column - 10, row - 12) < 6 ||
                                                    (column > 24 && row < 9) || column == row;
                                  return hole ? std::nan("") : test::mountains(column, row);
                              }));
    expect_metrics_as_defined(frame, test::make_heights(frame, [](int column, int row) {
                                  return column == 7 && row == 11 ? 500.0 : std::nan("");
                              }));
}

Raster<float> mountains_with_holes(const geo::GridFrame& frame) {
    return test::make_heights(frame, [](int column, int row) {
        const bool hole = std::hypot(column - 505, row - 515) < 30 || (column > 900 && row < 9);
        return hole ? std::nan("") : test::mountains(column, row);
    });
}

TEST(Metrics, OfTheIncrementalErrorAloneAreTheSame) {
    const auto frame = test::geographic_frame(1030, 540, 47, 11, 1.0 / 1200);
    const auto heights = mountains_with_holes(frame);
    const MetricRasters both = build_metrics(frame, {}, heights);
    const MetricRasters alone = build_metrics(frame, {}, heights, ObjectErrors::incremental);
    EXPECT_TRUE(alone.incremental.samples() == both.incremental.samples());
    EXPECT_TRUE(alone.radius.samples() == both.radius.samples());
    for (const std::uint16_t code : alone.bounded.samples()) ASSERT_EQ(code, 0);
}

// More than one tile a side, voids and data that ends inside a tile: what tiles add up to is what the whole
// grid gives. Small grids are compared with brute force above; this has its own scan of each diamond's
// bounding box, without tiles, halos or a lattice.
TEST(Metrics, DoNotDependOnTiles) {
    const auto frame = test::geographic_frame(1030, 540, 47, 11, 1.0 / 1200);
    const auto heights = mountains_with_holes(frame);
    const MetricRasters metrics = build_metrics(frame, {}, heights);
    const Raster<float> mesh = mesh_heights(frame, heights);
    const geo::PostPositions positions(frame);
    const auto position = [&](const GridPoint& p) {
        return positions.at(p.column, p.row, static_cast<double>(mesh.at(p.column, p.row)));
    };
    const auto valid = [&](const GridPoint& p) {
        return p.column < frame.columns && p.row < frame.rows && !std::isnan(heights.at(p.column, p.row));
    };
    const int n = frame.levels();
    // At every vertex of a coarse level, and at those of the fine ones around the corner of four tiles.
    int compared = 0;
    for (int level = 2 * n - 1; level >= 0; --level) {
        const int s = half_size(n, level);
        for (int row = 0; row < frame.padded_side(); ++row) {
            for_each_vertex_in_row(n, level, row, [&](const GridPoint& v) {
                const bool near_tile_corner = std::abs(v.column - 512) <= 20 && std::abs(v.row - 512) <= 20;
                const bool near_hole = std::abs(v.column - 505) <= 40 && std::abs(v.row - 512) <= 9;
                if (s < 64 && !near_tile_corner && !near_hole) return;
                const Diamond d = diamond(v, level, n);
                double own = 0;
                bool any = false;
                for (const GridPoint& apex : d.apexes) {
                    const GridPoint corner[3] = {d.left, d.right, apex};
                    const auto area = [](const GridPoint& a, const GridPoint& b, const GridPoint& c) {
                        return static_cast<double>((b.column - a.column)) * (c.row - a.row) -
                               static_cast<double>((b.row - a.row)) * (c.column - a.column);
                    };
                    const double all = area(corner[0], corner[1], corner[2]);
                    const auto [left, right] =
                        std::minmax({corner[0].column, corner[1].column, corner[2].column});
                    const auto [top, bottom] = std::minmax({corner[0].row, corner[1].row, corner[2].row});
                    for (int y = top; y <= bottom; ++y) {
                        for (int x = left; x <= right; ++x) {
                            const GridPoint p{x, y};
                            const double u = area(corner[1], corner[2], p) / all;
                            const double w = area(corner[2], corner[0], p) / all;
                            const double t = 1 - u - w;
                            if (u < -1e-12 || w < -1e-12 || t < -1e-12 || !valid(p)) continue;
                            const glm::dvec3 drawn =
                                u * position(corner[0]) + w * position(corner[1]) + t * position(corner[2]);
                            own = std::max(own, glm::distance(drawn, position(p)));
                            any = true;
                        }
                    }
                }
                const std::uint16_t radius = metrics.radius.at(v.column, v.row);
                EXPECT_TRUE(!any || radius > 0) << v.column << ' ' << v.row;
                double nested = own;
                for (const GridPoint& c : children(v, level, n)) {
                    nested =
                        std::max(nested, static_cast<double>(decode(metrics.bounded.at(c.column, c.row))));
                    const double child = static_cast<double>(decode(metrics.radius.at(c.column, c.row)));
                    if (child > 0) {
                        EXPECT_GE(static_cast<double>(decode(radius)),
                                  glm::distance(position(v), position(c)) + child);
                    }
                }
                const double bounded = static_cast<double>(decode(metrics.bounded.at(v.column, v.row)));
                EXPECT_GE(bounded, nested - 1e-7) << v.column << ' ' << v.row << " level " << level;
                EXPECT_LE(bounded, nested * kCodeStep + 1e-7) << v.column << ' ' << v.row;
                ++compared;
            });
        }
    }
    EXPECT_GT(compared, 1500);
}

TEST(Metrics, AreTheirDefinitionOnCoarsePostsAcrossTheEquator) {
    const auto frame = test::geographic_frame(17, 17, 4, 178, 0.5);
    expect_metrics_as_defined(frame, test::make_heights(frame, test::mountains));
}

// DESIGN: a flat plain must still be round. The sag of an edge is a closed form: r (1 - cos(half its angle)).
TEST(Metrics, FlatGroundStillCurves) {
    const auto frame = test::geographic_frame(65, 65, 0.008);
    const auto metrics = build_metrics(frame, {}, test::make_heights(frame, [](int, int) { return 0.0; }));
    const double half_angle = geo::Degrees{32.0 / 3600}.radians();
    const double equator_sag = 6378137 * (1 - std::cos(half_angle));
    const GridPoint north_side{32, 0};
    const double stored = static_cast<double>(decode(metrics.bounded.at(north_side.column, north_side.row)));
    EXPECT_GE(stored, equator_sag * 0.999);
    EXPECT_LE(stored, equator_sag * 2.1) << "the diamond's own diagonal adds at most as much again";
    EXPECT_GT(metrics.bounded.at(1, 0), 0) << "even between neighbouring posts";
}

TEST(Metrics, OneSpikeIsEveryAncestorsError) {
    const auto frame = test::geographic_frame(33, 33);
    const auto metrics = build_metrics(
        frame, {}, test::make_heights(frame, [](int c, int r) { return c == 13 && r == 7 ? 8000.0 : 0.0; }));
    const double root = static_cast<double>(decode(metrics.bounded.at(16, 16)));
    EXPECT_GE(root, 8000);
    EXPECT_LE(root, 8001 * kCodeStep);
}

// What an exaggeration adds: the bounds of the bare surface must hold for every diamond of the level.
void expect_level_bounds_hold(const geo::GridFrame& frame) {
    const Raster<float> flat = test::make_heights(frame, [](int, int) { return 0.0; });
    const auto geoid = geo::Geoid::egm96();
    ASSERT_TRUE(geoid) << geoid.error().message;
    const UndulationGrid undulations(std::make_shared<const geo::Geoid>(*geoid), frame);
    const MetricRasters metrics = build_metrics(frame, undulations, flat);
    const auto bounds = level_bounds(frame, undulations);
    for (int level = 0; level < 2 * frame.levels(); ++level) {
        const LevelBound& bound = bounds[static_cast<std::size_t>(level)];
        double sag = 0;
        double radius = 0;
        for (int row = 0; row < frame.padded_side(); ++row) {
            for_each_vertex_in_row(frame.levels(), level, row, [&](const GridPoint& v) {
                sag = std::max(sag, static_cast<double>(decode(metrics.bounded.at(v.column, v.row))));
                radius = std::max(radius, static_cast<double>(decode(metrics.radius.at(v.column, v.row))));
            });
        }
        EXPECT_GE(bound.sag_m * kCodeStep, sag) << "level " << level;
        // Stored spheres are rounded up at every level, each smaller than the next by the root of two.
        EXPECT_GE(bound.radius_m * (1 + 3.5 * (kCodeStep - 1)) + 1e-4, radius) << "level " << level;
        EXPECT_LE(bound.sag_m, 5 * sag + 1e-3) << "not wasteful, level " << level;
        EXPECT_LE(bound.radius_m, 2 * radius) << "not wasteful, level " << level;
    }
}

TEST(LevelBounds, HoldForEveryDiamond) {
    for (const double north : {0.5, 45.0, 80.0}) {
        for (const double step : {1.0 / 3600, 1.0 / 12})
            expect_level_bounds_hold(test::geographic_frame(65, 65, north, 10, step));
    }
}

TEST(LevelBounds, HoldForEveryDiamondAroundThePoles) {
    for (const geo::FrameKind kind : {geo::FrameKind::ups_north, geo::FrameKind::ups_south}) {
        for (const double step : {30.0, 9000.0}) {
            expect_level_bounds_hold(test::polar_frame(kind, 65, 65, step));             // the pole inside
            expect_level_bounds_hold(test::polar_frame(kind, 65, 65, step, 1e6, -9e5));  // 78 degrees
        }
        expect_level_bounds_hold(test::polar_frame(kind, 65, 65, 150e3));  // to 45 degrees
    }
}

}  // namespace
}  // namespace relevo::lod
