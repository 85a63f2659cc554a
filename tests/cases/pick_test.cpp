// Picking on real data: 10 000 random rays over five DEMs against a search of every cell that they pass.
#include "lod/soar/pick.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "lod/scene/scene.hpp"
#include "lod/soar/cell.hpp"
#include "tests/cases/real_dem.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::lod {
namespace {

using Vec = std::array<long double, 3>;

Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long double dot(const Vec& a, const Vec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec minus(const Vec& a, const Vec& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct BruteHit {
    long double distance_m = 0;
    GridPoint cell;
    long double to_edge = 0;  ///< how far inside its triangle, as part of it
};

/// All posts where they are, by GeographicLib.
class Brute {
  public:
    Brute(const Terrain& terrain, const SceneInfo& info)
        : frame_(terrain.frame()), lowest_m_(info.height_min_m - 200), highest_m_(info.height_max_m + 200) {
        posts_.resize(static_cast<std::size_t>(frame_.columns) * static_cast<std::size_t>(frame_.rows));
        tbb::parallel_for(0, frame_.rows, [&](int row) {
            TruePosts::Reader reader(terrain.posts());
            for (int column = 0; column < frame_.columns; ++column) {
                const auto H = static_cast<double>(reader.H(column, row));
                const geo::GridPosition place{static_cast<double>(column), static_cast<double>(row)};
                const double N = terrain.undulations().at(column, row);
                const geo::Ecef at = frame_.ecef(place, {N + H});
                post(column, row) = {at.m.x, at.m.y, at.m.z};  // NaN in voids
            }
        });
    }

    std::optional<BruteHit> nearest(const geo::Ecef& eye, const glm::dvec3& ray) const {
        const Vec from{eye.m.x, eye.m.y, eye.m.z};
        const Vec along{ray.x, ray.y, ray.z};
        const auto spacing = frame_.spacing({0.5 * frame_.columns, 0.5 * frame_.rows});
        const double step = 0.4 * std::min(spacing.column_m, spacing.row_m);
        std::optional<BruteHit> best;
        GridPoint last{-9, -9};
        bool was_below = false;
        for (double way = 0; way < 300e3 && !(best && way > static_cast<double>(best->distance_m) + 4 * step);
             way += step) {
            const geo::Geodetic at = geo::to_geodetic(eye + way * ray);
            if (at.h.m > highest_m_ + 60) {
                if (was_below || ray_rises(eye, ray, way)) break;
                way += std::max(0.0,
                                0.5 * (at.h.m - highest_m_ - 60) - step);  // it falls no faster than it goes
                continue;
            }
            if (at.h.m < lowest_m_ - 60) break;
            was_below = true;
            const geo::GridPosition place = frame_.grid_position({at.lat, at.lon});
            const GridPoint cell{static_cast<int>(std::floor(place.column)),
                                 static_cast<int>(std::floor(place.row))};
            if (cell == last) continue;
            last = cell;
            for (int y = cell.row - 1; y <= cell.row + 1; ++y) {
                for (int x = cell.column - 1; x <= cell.column + 1; ++x) try_cell({x, y}, from, along, best);
            }
        }
        return best;
    }

  private:
    Vec& post(int column, int row) {
        return posts_[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame_.columns) +
                      static_cast<std::size_t>(column)];
    }
    const Vec& post(int column, int row) const { return const_cast<Brute*>(this)->post(column, row); }

    bool ray_rises(const geo::Ecef& eye, const glm::dvec3& ray, double way) const {
        return geo::to_geodetic(eye + (way + 1) * ray).h.m > geo::to_geodetic(eye + way * ray).h.m;
    }

    void try_cell(const GridPoint& cell, const Vec& from, const Vec& along,
                  std::optional<BruteHit>& best) const {
        if (cell.column < 0 || cell.row < 0 || cell.column + 1 >= frame_.columns ||
            cell.row + 1 >= frame_.rows)
            return;
        for (int k = 0; k < 4; ++k) {
            if (std::isnan(static_cast<double>(post(cell.column + k % 2, cell.row + k / 2)[0]))) return;
        }
        for (const CellTriangle& t : cell_triangles(cell)) {
            std::array<Vec, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = minus(post(t[k].column, t[k].row), from);
            const Vec normal = cross(minus(p[1], p[0]), minus(p[2], p[0]));
            const long double distance = dot(p[0], normal) / dot(along, normal);
            if (!(distance >= 0) || (best && distance >= best->distance_m)) continue;
            const Vec at{distance * along[0], distance * along[1], distance * along[2]};
            long double inside = 1;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec side = cross(minus(p[(k + 1) % 3], p[k]), minus(at, p[k]));
                inside = std::min(inside, dot(side, normal) / dot(normal, normal));
            }
            if (inside >= -1e-12L) best = BruteHit{distance, cell, inside};
        }
    }

    const geo::GridFrame& frame_;
    double lowest_m_;
    double highest_m_;
    std::vector<Vec> posts_;
};

class PickingRealDems : public testing::TestWithParam<test::RealDem> {};

TEST_P(PickingRealDems, FindsTheCellThatASearchOfAllFinds) {
    RELEVO_NEEDS_DATA(GetParam().file);
    const test::SceneFolder folder;
    const auto scene = test::import_real(GetParam(), folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto terrain = Terrain::open(*scene, ErrorMetric::bounded, {.fade_s = 0});
    ASSERT_TRUE(terrain) << terrain.error().message;

    constexpr int kRays = 2000;
    constexpr unsigned kSeed = 42;
    std::mt19937_64 random(kSeed);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    struct Ray {
        geo::Ecef eye;
        glm::dvec3 along;
    };
    std::vector<Ray> rays;
    const geo::GridFrame& frame = terrain->frame();
    for (int i = 0; i < kRays; ++i) {
        const geo::GridPosition place{any(0, frame.columns - 1), any(0, frame.rows - 1)};
        const geo::Ecef eye = frame.ecef(
            place, {terrain->undulations().at(place) + scene->info().height_max_m + any(10, 8000)});
        const geo::EnuFrame local(geo::to_geodetic(eye));
        const double azimuth = any(0, 2 * M_PI);
        const double down = geo::Degrees{any(1, 90)}.radians();
        rays.push_back(
            {eye, std::cos(down) * (std::sin(azimuth) * local.east() + std::cos(azimuth) * local.north()) -
                      std::sin(down) * local.up()});
    }

    const Brute brute(*terrain, scene->info());
    std::vector<std::optional<BruteHit>> expected(kRays);
    tbb::parallel_for(0, kRays, [&](int i) {
        const Ray& ray = rays[static_cast<std::size_t>(i)];
        expected[static_cast<std::size_t>(i)] = brute.nearest(ray.eye, ray.along);
    });
    int hits = 0;
    std::vector<double> us;
    for (std::size_t i = 0; i < kRays; ++i) {
        (void)pick_exactly(*terrain, rays[i].eye, rays[i].along);  // what it needs is in memory then
        const auto start = std::chrono::steady_clock::now();
        const auto hit = pick_exactly(*terrain, rays[i].eye, rays[i].along);
        us.push_back(
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
        ASSERT_EQ(hit.has_value(), expected[i].has_value()) << "ray " << i << ", seed " << kSeed;
        if (!hit) continue;
        ++hits;
        EXPECT_TRUE(hit->is_exact);
        EXPECT_NEAR(hit->distance_m, static_cast<double>(expected[i]->distance_m), 1e-3) << "ray " << i;
        if (expected[i]->to_edge < 1e-6L) continue;  // on an edge either cell is right
        EXPECT_EQ(static_cast<int>(std::floor(hit->place.column)), expected[i]->cell.column) << "ray " << i;
        EXPECT_EQ(static_cast<int>(std::floor(hit->place.row)), expected[i]->cell.row) << "ray " << i;
    }
    EXPECT_GT(hits, kRays / 4);
    std::nth_element(us.begin(), us.begin() + kRays / 2, us.end());
    std::cout << GetParam().name << ": " << hits << " of " << kRays << " rays hit; median " << us[kRays / 2]
              << " us a ray\n";
}

INSTANTIATE_TEST_SUITE_P(All, PickingRealDems,
                         testing::Values(test::RealDem{"Rainier", "mountains/mt_rainier_90m.tif", ""},
                                         test::RealDem{"Everest", "mountains/mt_everest_90m.tif", ""},
                                         test::RealDem{"Baltoro", "mountains/baltoro.tif", ""},
                                         test::RealDem{"BigTujunga", "mountains/bigtujunga.tif", ""},
                                         test::RealDem{"Columbia", "coast/columbia.tif", ""}),
                         [](const auto& all) { return std::string(all.param.name); });

}  // namespace
}  // namespace relevo::lod
