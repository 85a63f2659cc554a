#include "lod/ocean/radial_grid.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relevo::lod {
namespace {

struct Trial {
    explicit Trial(double height_m, double pitch = -20, double wind_m_s = 8, double fov = 60)
        : view({.eye = {geo::Degrees{43.6}, geo::Degrees{7.25}, geo::EllipsoidalHeight{height_m}},
                .heading = geo::Degrees{60},
                .pitch = geo::Degrees{pitch},
                .roll = geo::Degrees{0},
                .fov = geo::Degrees{fov}}),
          chart({geo::Degrees{43.5}, geo::Degrees{7.5}}),
          waves(Waves::of_wind({.speed_m_s = wind_m_s, .from = geo::Degrees{300}})),
          sea(view, chart, 0, waves.crest_m()),
          spacing(waves, height_px(view), 1, 6371e3) {}

    OceanPicture arrange(const RadialGrid& mesh) const {
        OceanPicture picture;
        mesh.arrange(
            sea, spacing, [](const glm::dvec2&, double) { return Water::open; }, picture);
        return picture;
    }

    View view;
    SeaChart chart;
    Waves waves;
    SeaView sea;
    SeaSpacing spacing;
};

TEST(RadialReference, EndsAreTheDistancesThatAreGiven) {
    for (const double k : {1.0, 2.0, 4.0}) {
        const RadialShape shape = radial_shape(0.5, 5048, k, 257, 128);
        EXPECT_DOUBLE_EQ(shape.radius_m(0), 0.5);      // a0
        EXPECT_NEAR(shape.radius_m(256), 5048, 1e-9);  // a0 + a1 (N - 1)^k
        EXPECT_NEAR(shape.growth_m, 5047.5 / std::pow(256, k), 1e-12);
        for (int i = 1; i < 257; ++i) EXPECT_GT(shape.radius_m(i), shape.radius_m(i - 1));
    }
    EXPECT_EQ(RadialShape{}.exponent, 2);
}

TEST(RadialReference, SpacingIsThatOfItsCells) {
    const RadialShape shape = radial_shape(0.5, 5048, 2, 257, 128);
    const RadialRings rings = rings_of(shape);
    ASSERT_EQ(rings.blocks.size(), 17U);
    for (std::size_t block = 0; block < rings.blocks.size(); ++block) {
        const int ring = 16 * static_cast<int>(block);
        EXPECT_NEAR(rings.blocks[block].radius_m, shape.radius_m(ring), 1e-9);
        const double outward = ring < 256 ? shape.radius_m(ring + 1) - shape.radius_m(ring)
                                          : shape.radius_m(ring) - shape.radius_m(ring - 1);
        const double around = 2 * std::numbers::pi * shape.radius_m(ring) / shape.sectors;
        EXPECT_NEAR(rings.spacing_m(block), std::max(outward, around), 1e-9) << ring;
    }
}

TEST(RadialGrid, KeepsToTheSpacingFromTheNadirToTheHorizon) {
    for (const double height : {2.0, 50.0, 2e3, 5e4, 1e7}) {
        const Trial trial(height);
        const RadialRings rings = rings_for(trial.sea, trial.spacing);
        EXPECT_EQ(rings.sectors % RadialGrid::kBlockCells, 0);
        EXPECT_GE(rings.blocks.back().radius_m, trial.sea.reach_m);
        for (std::size_t i = 0; i < rings.blocks.size(); ++i) {
            if (rings.blocks[i].radius_m > trial.sea.reach_m) continue;
            const double away = trial.sea.error_distance_m(rings.blocks[i].radius_m);
            EXPECT_LE(rings.spacing_m(i), 1.1 * trial.spacing.at(RadialGrid::kSlack * away))
                << height << " m, ring " << i;
        }
    }
}

TEST(RadialGrid, ReachesTheHorizonWhateverTheErrorIs) {
    const Trial trial(20);
    const SeaSpacing next_to_nothing(trial.waves, height_px(trial.view), 1e-6, 6371e3);
    const RadialRings rings = rings_for(trial.sea, next_to_nothing);
    EXPECT_GE(rings.blocks.back().radius_m, trial.sea.reach_m);
    EXPECT_LT(rings.blocks.size(), OceanPicture::kMostNumbers);
}

TEST(RadialGrid, CoversTheWholeCircleOnce) {
    const RadialShape shape = radial_shape(1, 2000, 2, 65, 64);
    const RadialGrid mesh(shape);
    const OceanPicture picture = Trial(100, -90, 8, 177).arrange(mesh);
    ASSERT_EQ(picture.copies.size(), 2U);
    std::set<std::pair<int, int>> blocks;
    for (const glm::vec4& copy : picture.copies[0].open) blocks.emplace(copy.x, copy.y);
    EXPECT_EQ(blocks.size(), picture.copies[0].open.size());
    EXPECT_EQ(blocks.size(), 16U);                 // 4 of rings times 4 of sectors
    EXPECT_EQ(picture.copies[1].open.size(), 4U);  // fans
    // The area of its triangles is that of the polygons between circles: nothing is twice, nothing left out.
    const auto at = [&](int ring, int sector) {
        const double angle = 2 * std::numbers::pi * (sector % shape.sectors) / shape.sectors;
        return ring < 0 ? glm::dvec2(0) : shape.radius_m(ring) * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    double area = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const OceanPatch& patch = mesh.patches()[i];
        for (const glm::vec4& copy : picture.copies[i].open) {
            for (std::size_t t = 0; t < patch.indices.size(); t += 3) {
                glm::dvec2 p[3];
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::i16vec2 vertex = patch.vertices[patch.indices[t + k]];
                    p[k] =
                        at(vertex.x < 0 ? -1 : RadialGrid::kBlockCells * static_cast<int>(copy.x) + vertex.x,
                           static_cast<int>(copy.y) + vertex.y);
                }
                const glm::dvec2 u = p[1] - p[0], v = p[2] - p[0];
                const double part = 0.5 * (u.x * v.y - u.y * v.x);
                EXPECT_GT(part, 0);  // counter-clockwise from above
                area += part;
            }
        }
    }
    const double outer = shape.radius_m(shape.rings - 1);
    EXPECT_NEAR(area, 0.5 * shape.sectors * outer * outer * std::sin(2 * std::numbers::pi / shape.sectors),
                1e-6 * area);
}

TEST(RadialGrid, SlicesOutOfViewAreNotDrawn) {
    const RadialGrid mesh(radial_shape(1, 20000, 2, 65, 128));
    const auto count = [&](const Trial& trial) {
        const OceanPicture picture = trial.arrange(mesh);
        return picture.copies[0].open.size() + picture.copies[1].open.size();
    };
    EXPECT_EQ(count(Trial(50, 90)), 0U);
    EXPECT_LT(count(Trial(50, 0)), 0.6 * static_cast<double>(count(Trial(50, -90, 8, 179))));
}

}  // namespace
}  // namespace relevo::lod
