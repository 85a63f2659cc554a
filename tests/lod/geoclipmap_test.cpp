#include "lod/ocean/geoclipmap.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relevo::lod {
namespace {

Camera camera(double height_m, double pitch = -20) {
    return {.eye = {geo::Degrees{43.6}, geo::Degrees{7.25}, geo::EllipsoidalHeight{height_m}},
            .heading = geo::Degrees{60},
            .pitch = geo::Degrees{pitch},
            .roll = geo::Degrees{0}};
}

/// The sea around a camera, raised by a wind.
struct Trial {
    explicit Trial(const Camera& of, double wind_m_s = 8, double error_px = 1)
        : view(of),
          chart({geo::Degrees{43.5}, geo::Degrees{7.5}}),
          waves(Waves::of_wind({.speed_m_s = wind_m_s, .from = geo::Degrees{300}})),
          sea(view, chart, 0, waves.crest_m()),
          spacing(waves, height_px(view), error_px, 6371e3) {}

    OceanPicture arrange(const Geoclipmap& mesh, Water everywhere = Water::open) const {
        OceanPicture picture;
        mesh.arrange(
            sea, spacing, [&](const glm::dvec2&, double) { return everywhere; }, picture);
        return picture;
    }

    View view;
    SeaChart chart;
    Waves waves;
    SeaView sea;
    SeaSpacing spacing;
};

TEST(GeoclipmapReference, CountsOfRings) {
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(blocks_a_side(i), 1 + 2 * i);  // D_i
        const int inside = i == 0 ? 0 : blocks_a_side(i - 1) * blocks_a_side(i - 1);
        EXPECT_EQ(blocks_of_ring(i), blocks_a_side(i) * blocks_a_side(i) - inside);
    }
    constexpr int k = 512;
    EXPECT_EQ(cells_of_ring(0, k), long{k} * k);                                                    // T_0
    for (int i = 1; i < 8; ++i) EXPECT_EQ(cells_of_ring(i, k >> i), 8L * i * (k >> i) * (k >> i));  // T_i
    // The reference says that each ring has fewer than the one inside of it. The first has twice as many.
    EXPECT_EQ(cells_of_ring(1, k / 2), 2 * cells_of_ring(0, k));
    for (int i = 2; i < 8; ++i) EXPECT_LT(cells_of_ring(i, k >> i), cells_of_ring(i - 1, k >> (i - 1)));
}

TEST(GeoclipmapReference, ItsOwnShapeIsDrawnBlockByBlock) {
    const std::vector<int> levels{0, 1, 1, 2, 2, 2, 2};
    const Geoclipmap mesh(geoclipmap_shape(64, 100, levels));
    Camera down = camera(1e5, -90);
    down.fov = geo::Degrees{150};
    const OceanPicture picture = Trial(down).arrange(mesh);
    std::map<int, int> blocks;
    for (std::size_t patch = 0; patch < picture.copies.size(); ++patch) {
        for (const glm::vec4& copy : picture.copies[patch].open) {
            const int ring = static_cast<int>(copy.z);
            ++blocks[ring];
            EXPECT_EQ(1 << patch, 64 >> levels[static_cast<std::size_t>(ring)]);
        }
    }
    ASSERT_EQ(blocks.size(), levels.size());
    for (const auto& [ring, count] : blocks) EXPECT_EQ(count, blocks_of_ring(ring));
}

TEST(Geoclipmap, PatchesHaveAVertexMoreThanCellsASide) {
    const Geoclipmap mesh;
    int cells = 1;
    for (const OceanPatch& patch : mesh.patches()) {
        EXPECT_EQ(patch.vertices.size(), static_cast<std::size_t>(cells + 1) * (cells + 1));
        EXPECT_EQ(patch.triangles(), std::size_t{2} * cells * cells);
        cells *= 2;
    }
    EXPECT_EQ(cells, 2 * Geoclipmap::kMostCells);
}

TEST(Geoclipmap, SpacingIsKeptEverywhereAndReachesTheHorizon) {
    for (const double height : {2.0, 50.0, 2e3, 5e4, 1e7}) {
        const Trial trial(camera(height));
        const GeoclipmapShape shape = geoclipmap_shape_for(trial.sea, trial.spacing);
        double before = 0;
        for (const auto& ring : shape.rings) {
            EXPECT_GE(ring.spacing_m(), before);
            before = ring.spacing_m();
            const double away = trial.sea.error_distance_m(ring.inner_m());
            if (ring.cells > 1 && ring.cells < Geoclipmap::kMostCells) {
                EXPECT_LE(ring.spacing_m(), 1.001 * trial.spacing.at(away)) << height;
            }
        }
        EXPECT_GE(shape.rings.back().outer_m(), trial.sea.reach_m) << height;
    }
}

/// What the shader does with a vertex (shaders/ocean_geoclipmap.vert): its place, exactly, as whole numbers
/// of floats.
std::pair<float, float> placed(const OceanPicture& picture, const glm::vec4& copy,
                               const glm::i16vec2& corner) {
    const auto at = static_cast<std::size_t>(4 * static_cast<int>(copy.z));
    const glm::vec4 own = picture.numbers[at], next = picture.numbers[at + 1], move = picture.numbers[at + 2];
    const glm::vec2 post = glm::vec2(copy) + glm::vec2(corner);
    const glm::vec2 fine = own.x * post + glm::vec2(own.y, own.z);
    const glm::vec2 coarse = own.w * (glm::vec2(std::floor(post.x / next.w + next.z + 0.5F),
                                                std::floor(post.y / next.w + next.z + 0.5F)) -
                                      next.z) +
                             glm::vec2(next.x, next.y);
    const float away = std::max(std::abs(fine.x), std::abs(fine.y));
    const float moved = std::clamp((away - move.x) / (move.y - move.x), 0.0F, 1.0F);
    const glm::vec2 place = moved < 1 ? fine * (1 - moved) + coarse * moved : coarse;
    return {place.x, place.y};
}

TEST(Geoclipmap, EveryEdgeBelongsToTwoTriangles) {
    for (const double height : {2.0, 100.0}) {
        for (const double east : {0.37, 123.456}) {
            Camera down = camera(height, -90);
            down.fov = geo::Degrees{179};
            down.eye.lon.value += east / 8e4;
            const Trial trial(down, 8, 500);
            const Geoclipmap mesh;
            const OceanPicture picture = trial.arrange(mesh);
            using Point = std::pair<float, float>;
            std::map<std::pair<Point, Point>, int> edges;
            double reached = 0;
            for (std::size_t i = 0; i < picture.copies.size(); ++i) {
                const OceanPatch& patch = mesh.patches()[i];
                for (const glm::vec4& copy : picture.copies[i].open) {
                    for (std::size_t t = 0; t < patch.indices.size(); t += 3) {
                        Point corners[3];
                        for (std::size_t k = 0; k < 3; ++k)
                            corners[k] = placed(picture, copy, patch.vertices[patch.indices[t + k]]);
                        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2])
                            continue;
                        for (std::size_t k = 0; k < 3; ++k) {
                            const Point a = corners[k], b = corners[(k + 1) % 3];
                            edges[{a, b}] += 1;
                            edges[{b, a}] -= 1;
                            reached = std::max(reached, static_cast<double>(std::abs(a.first)));
                        }
                    }
                }
            }
            // Edges that one triangle has lie on the border of what is in view, far out.
            int torn = 0;
            const double inside = 40 * height;
            EXPECT_GT(reached, 2 * inside);
            for (const auto& [edge, balance] : edges) {
                const auto near = [&](const Point& p) {
                    return std::abs(p.first) < inside && std::abs(p.second) < inside;
                };
                torn += balance != 0 && near(edge.first) && near(edge.second) ? 1 : 0;
            }
            EXPECT_EQ(torn, 0) << height << " m, " << east << " m east, of " << edges.size();
        }
    }
}

TEST(Geoclipmap, VerticesInTheMiddleOfARingStayWhereTheyAre) {
    // The same posts of the lattice before and after the eye has moved: the same places in the chart.
    Camera from = camera(2, -30);
    Camera to = from;
    to.eye.lon.value += 0.6e-6;  // 5 cm
    to.eye.h.m += 0.01;
    const Trial before(from), after(to);
    const Geoclipmap mesh;
    double off = 0;  // the lattice, posts
    const auto places = [&](const Trial& trial) {
        std::set<std::pair<long, long>> found;
        const OceanPicture picture = trial.arrange(mesh);
        const double spacing_m = geoclipmap_shape_for(trial.sea, trial.spacing).rings.front().spacing_m();
        for (std::size_t i = 0; i < picture.copies.size(); ++i) {
            for (const glm::vec4& copy : picture.copies[i].open) {
                if (copy.z != 0) continue;
                for (const auto& corner : mesh.patches()[i].vertices) {
                    const auto [x, y] = placed(picture, copy, corner);
                    if (std::max(std::abs(x), std::abs(y)) >= picture.numbers[2].x) continue;  // on its way
                    // Of the ring's lattice, which is fixed in the chart.
                    const glm::dvec2 post = (trial.sea.nadir + glm::dvec2(x, y)) / spacing_m;
                    off = std::max(off, glm::distance(post, glm::round(post)));
                    found.emplace(std::lround(post.x), std::lround(post.y));
                }
            }
        }
        return found;
    };
    const auto a = places(before), b = places(after);
    ASSERT_FALSE(a.empty());
    EXPECT_LT(off, 1e-3);
    std::vector<std::pair<long, long>> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    EXPECT_GT(both.size(), 0.7 * static_cast<double>(a.size()));
}

TEST(Geoclipmap, AFlatSeaIsTwoTrianglesABlock) {
    for (const double height : {2.0, 300.0, 5e4, 1e7}) {
        const Trial trial(camera(height, height > 1e6 ? -90 : -20), 0);
        const Geoclipmap mesh;
        const OceanPicture picture = trial.arrange(mesh);
        std::size_t blocks = 0;
        for (std::size_t i = 0; i < picture.copies.size(); ++i) {
            EXPECT_TRUE(i == 0 || picture.copies[i].open.empty());
            blocks += picture.copies[i].open.size();
        }
        EXPECT_GT(blocks, 0U);
        EXPECT_LT(blocks, 6000U);
    }
}

TEST(Geoclipmap, HasNumbersForAllItsRingsWhateverTheErrorIs) {
    for (const double wind : {0.0, 8.0}) {
        const Trial trial(camera(20), wind, 1e-6);
        const auto rings = geoclipmap_shape_for(trial.sea, trial.spacing).rings.size();
        EXPECT_LE(rings * Geoclipmap::kRingNumbers, OceanPicture::kMostNumbers);
    }
}

TEST(Geoclipmap, BlocksOverLandAndOutOfViewAreNotDrawn) {
    const Geoclipmap mesh;
    const auto count = [&](const OceanPicture& picture) {
        std::size_t all = 0;
        for (const auto& [open, shore] : picture.copies) all += open.size() + shore.size();
        return all;
    };
    EXPECT_EQ(count(Trial(camera(50)).arrange(mesh, Water::none)), 0U);
    EXPECT_EQ(count(Trial(camera(50, 90)).arrange(mesh)), 0U);
    const std::size_t ahead = count(Trial(camera(50, 0)).arrange(mesh));
    Camera wide = camera(50, -90);
    wide.fov = geo::Degrees{170};
    EXPECT_GT(count(Trial(wide).arrange(mesh)), 2 * ahead);
    const OceanPicture shore = Trial(camera(50)).arrange(mesh, Water::shore);
    for (const auto& copies : shore.copies) EXPECT_TRUE(copies.open.empty());
}

}  // namespace
}  // namespace relevo::lod
