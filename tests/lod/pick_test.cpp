#include "lod/soar/pick.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/sample_views.hpp"
#include "lod/soar/cell.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

/// Every triangle of every cell, one after the other, by solving for the plane (not by Moeller & Trumbore).
std::optional<double> nearest_by_brute_force(const Terrain& terrain, const geo::Ecef& eye,
                                             const glm::dvec3& ray, double exaggeration) {
    std::optional<double> nearest;
    TruePosts::Reader posts(terrain.posts());
    for (int row = 0; row + 1 < terrain.frame().rows; ++row) {
        for (int column = 0; column + 1 < terrain.frame().columns; ++column) {
            if (!posts.is_valid_cell(column, row)) continue;
            for (const CellTriangle& t : cell_triangles({column, row})) {
                glm::dvec3 p[3];
                for (int k = 0; k < 3; ++k) {
                    const GridPoint& c = t[static_cast<std::size_t>(k)];
                    const geo::GridPosition place{static_cast<double>(c.column), static_cast<double>(c.row)};
                    const double H = static_cast<double>(posts.H(c.column, c.row));
                    p[k] = terrain.frame().ecef(place, {exaggeration * H}) - eye;
                }
                const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
                const double distance = glm::dot(p[0], normal) / glm::dot(ray, normal);
                if (!(distance >= 0)) continue;
                const glm::dvec3 at = distance * ray;
                bool inside = true;
                for (int k = 0; k < 3; ++k) {
                    const glm::dvec3 side = glm::cross(p[(k + 1) % 3] - p[k], at - p[k]);
                    inside = inside && glm::dot(side, normal) >= -1e-9 * glm::dot(normal, normal);
                }
                if (inside && (!nearest || distance < *nearest)) nearest = distance;
            }
        }
    }
    return nearest;
}

class PickTest : public testing::TestWithParam<double> {};

TEST_P(PickTest, AgreesWithBruteForce) {
    const auto frame = test::geographic_frame(65, 40);
    const Terrain terrain =
        test::make_terrain(frame, test::make_heights(frame, [](int c, int r) {
                               return std::hypot(c - 20, r - 20) < 5 ? std::nan("") : test::mountains(c, r);
                           }));
    std::mt19937_64 random(20261122);
    int hits = 0;
    int misses = 0;
    for (Camera camera : sample_views(terrain, 30, 9, 640, 360)) {
        camera.eye.h.m *= GetParam();  // stay above the exaggerated ground
        const View view(camera);
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 ray =
                view.ray({static_cast<double>(random() % 640), static_cast<double>(random() % 360)});
            const auto expected = nearest_by_brute_force(terrain, view.eye(), ray, GetParam());
            const auto hit = pick_exactly(terrain, view.eye(), ray, GetParam());
            ASSERT_EQ(hit.has_value(), expected.has_value()) << "seed 20261122";
            if (!hit) {
                ++misses;
                continue;
            }
            ++hits;
            EXPECT_NEAR(hit->distance_m, *expected, 1e-3);
            // The place that it names is where the ray is: on the same vertical to a few centimetres of chord
            // and sag.
            const geo::Geodetic at = geo::to_geodetic(view.eye() + hit->distance_m * ray);
            const geo::GridPosition place = frame.grid_position({at.lat, at.lon});
            EXPECT_NEAR(place.column, hit->place.column, 0.01);
            EXPECT_NEAR(place.row, hit->place.row, 0.01);
        }
    }
    EXPECT_GT(hits, 100);
    EXPECT_GT(misses, 20);
}

INSTANTIATE_TEST_SUITE_P(Exaggerations, PickTest, testing::Values(1.0, 5.0));

}  // namespace
}  // namespace relevo::lod
