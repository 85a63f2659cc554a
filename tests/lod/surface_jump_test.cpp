#include "lod/surface_jump.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/soar/refiner.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

glm::dvec3 offset_of(const MeshVertex& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The mesh's surface at a post, by looking at every triangle.
std::optional<glm::dvec3> surface_at(const Mesh& mesh, int column, int row) {
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
        const MeshVertex* c[3] = {&mesh.vertices[mesh.indices[k]], &mesh.vertices[mesh.indices[k + 1]],
                                  &mesh.vertices[mesh.indices[k + 2]]};
        const auto cross = [&](int i, int j, double x, double y) {
            return (c[j]->column - c[i]->column) * (y - c[i]->row) -
                   (c[j]->row - c[i]->row) * (x - c[i]->column);
        };
        const double area = cross(0, 1, c[2]->column, c[2]->row);
        const double u = cross(1, 2, column, row) / area;
        const double v = cross(2, 0, column, row) / area;
        const double w = cross(0, 1, column, row) / area;
        if (u >= 0 && v >= 0 && w >= 0)
            return u * offset_of(*c[0]) + v * offset_of(*c[1]) + w * offset_of(*c[2]);
    }
    return std::nullopt;
}

Camera camera(const Terrain& terrain, double column, double row, double metres) {
    Camera c;
    c.eye = test::above(terrain, column, row, metres);
    c.heading = geo::Degrees{20};
    c.pitch = geo::Degrees{-25};
    c.width = 320;
    c.height = 180;
    return c;
}

class Jumps : public testing::TestWithParam<bool> {};

// Truth: every post of the grid, by brute force. A bisection's meshes part farthest at their vertices, and
// these are posts: so brute force finds the same, but for what perspective does between them.
TEST_P(Jumps, AreWhatBruteForceOverAllPostsFinds) {
    const auto frame = test::geographic_frame(65, 60);
    const Terrain terrain = test::make_terrain(frame, test::make_heights(frame, test::mountains));
    Refiner first(terrain);
    Refiner second(terrain);
    double largest = 0;
    for (int step = 0; step < 6; ++step) {
        const View before(camera(terrain, 30, 55 - 3 * step, 900));
        const View after(camera(terrain, 30, 54 - 3 * step, 880));
        const RefineOptions options{.tau_px = 3, .morph = GetParam()};
        const Mesh& old_mesh = first.refine(before, options);
        const Mesh& new_mesh = second.refine(after, options);
        const auto jump = surface_jump(old_mesh, before.eye(), new_mesh, after, frame.columns, frame.rows);
        ASSERT_TRUE(jump);
        double truth = 0;
        const glm::dvec3 shift = before.eye() - after.eye();
        for (int row = 0; row < frame.rows; ++row) {
            for (int column = 0; column < frame.columns; ++column) {
                const auto is = surface_at(new_mesh, column, row);
                if (!is || !after.sees(*is)) continue;
                const auto was = surface_at(old_mesh, column, row);
                if (was) truth = std::max(truth, glm::distance(after.pixel(*was + shift), after.pixel(*is)));
            }
        }
        EXPECT_LE(jump->max_px, truth + 1e-9);
        EXPECT_GE(jump->max_px, 0.98 * truth);
        EXPECT_LE(jump->p99_px, jump->max_px);
        EXPECT_GT(jump->vertices, 30u);
        largest = std::max(largest, truth);
    }
    EXPECT_GT(largest, GetParam() ? 0.05 : 0.5) << "or there was nothing to find";
}

INSTANTIATE_TEST_SUITE_P(Morph, Jumps, testing::Bool());

TEST(SurfaceJump, OneVertexThatAppearsJumpsByItsHeight) {
    // Two triangles over a square, and the same with its centre lifted by 10 m at 1000 m: from straight above
    // the lift is along the ray, so the eye stands to the side.
    const View view({.eye = {geo::Degrees{0}, geo::Degrees{0}, {0}},
                     .heading = {},
                     .pitch = {},
                     .roll = {},
                     .fov = geo::Degrees{90},
                     .width = 1000,
                     .height = 1000});
    const auto vertex = [&](double right, double up, int column, int row) {
        const glm::vec3 p(1000.0 * view.forward() + right * view.right() + up * view.up());
        return MeshVertex{p.x, p.y, p.z, static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)};
    };
    Mesh flat;
    flat.vertices = {vertex(-100, 0, 0, 0), vertex(100, 0, 2, 0), vertex(-100, -200, 0, 2),
                     vertex(100, -200, 2, 2)};
    flat.indices = {2, 1, 0, 1, 2, 3};
    Mesh lifted = flat;
    lifted.vertices.push_back(vertex(0, -90, 1, 1));
    lifted.indices = {0, 2, 4, 2, 3, 4, 3, 1, 4, 1, 0, 4};
    const auto up = surface_jump(flat, view.eye(), lifted, view, 3, 3);
    ASSERT_TRUE(up);
    EXPECT_NEAR(up->max_px, 10.0 * 500 / 1000, 1e-3);  // focal length 500 pixels
    EXPECT_EQ(up->vertices, 5u);
    const auto down = surface_jump(lifted, view.eye(), flat, view, 3, 3);
    ASSERT_TRUE(down);
    EXPECT_NEAR(down->max_px, 5, 1e-3);
    const auto none = surface_jump(lifted, view.eye(), lifted, view, 3, 3);
    ASSERT_TRUE(none);
    EXPECT_EQ(none->max_px, 0);
    // The eye moved by 1 m to the right, and the mesh was made for it: nothing jumped.
    const auto moved = surface_jump(
        flat, view.eye() + -1.0 * view.right(),
        [&] {
            Mesh again = flat;
            for (MeshVertex& v : again.vertices) {
                const glm::vec3 p(offset_of(v) - view.right());
                v.x = p.x, v.y = p.y, v.z = p.z;
            }
            return again;
        }(),
        view, 3, 3);
    ASSERT_TRUE(moved);
    EXPECT_LT(moved->max_px, 1e-3);
    EXPECT_FALSE(surface_jump({}, view.eye(), lifted, view, 3, 3)) << "nothing to compare with";
    EXPECT_FALSE(surface_jump(flat, view.eye(), lifted, view, 0, 0)) << "padding";
}

}  // namespace
}  // namespace relevo::lod
