#include "lod/oracle.hpp"

#include <gtest/gtest.h>

#include "lod/soar/full_mesh.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

// A judge that cannot find a fault is none: each test here makes one and wants it found.
class OracleTest : public testing::Test {
  protected:
    OracleTest()
        : frame_(test::geographic_frame(33, 33)),
          terrain_(test::make_terrain(frame_, test::make_heights(frame_, test::mountains))) {
        camera_.eye = test::above(terrain_, 16, 16, 700);
        camera_.pitch = geo::Degrees{-90};
        camera_.width = 320;
        camera_.height = 200;
    }

    geo::GridFrame frame_;
    Terrain terrain_;
    Camera camera_;
};

TEST_F(OracleTest, FindsNothingInTheFullMesh) {
    const View view(camera_);
    const auto error = measure_error(terrain_, view, full_mesh(terrain_, view, 1));
    ASSERT_TRUE(error);
    EXPECT_LT(error->max_px, 1e-3) << "rounding to float";
    EXPECT_EQ(error->uncovered_posts, 0u);
    EXPECT_GT(error->posts, 100u);
    EXPECT_GT(error->pixels, 30000u);
}

TEST_F(OracleTest, MeasuresAKnownShift) {
    const View view(camera_);
    Mesh mesh = full_mesh(terrain_, view, 1);
    for (MeshVertex& v : mesh.vertices) {
        v.x += static_cast<float>(view.right().x);
        v.y += static_cast<float>(view.right().y);
        v.z += static_cast<float>(view.right().z);
    }
    const auto error = measure_error(terrain_, view, mesh);
    ASSERT_TRUE(error);
    // One metre to the right: focal / depth pixels, and the nearest ground is a good 600 m away.
    double nearest = 1e9;
    for (int row = 0; row < 33; ++row) {
        for (int column = 0; column < 33; ++column) {
            const glm::dvec3 offset = terrain_.position(column, row, 1) - view.eye().m;
            if (view.sees(offset)) nearest = std::min(nearest, view.depth(offset));
        }
    }
    EXPECT_NEAR(error->max_px, view.focal_px() / nearest, 0.02 * error->max_px);
    EXPECT_GT(error->rms_px, 0.5 * error->max_px);
}

TEST_F(OracleTest, FindsAHole) {
    const View view(camera_);
    Mesh mesh = full_mesh(terrain_, view, 1);
    const auto touches = [&](std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const MeshVertex& v = mesh.vertices[mesh.indices[3 * t + k]];
            if (v.column == 16 && v.row == 16) return true;
        }
        return false;
    };
    Mesh holed = mesh;
    holed.indices.clear();
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        if (touches(t)) continue;
        holed.indices.insert(holed.indices.end(), &mesh.indices[3 * t], &mesh.indices[3 * t] + 3);
    }
    const auto error = measure_error(terrain_, view, holed);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->uncovered_posts, 1u);
}

TEST_F(OracleTest, FindsOneWrongVertexBetweenPostsToo) {
    camera_.eye =
        test::above(terrain_, 16.5, 16.5, 3);  // closer than the posts are apart: no post in the picture
    const View view(camera_);
    Mesh mesh = full_mesh(terrain_, view, 1);
    for (MeshVertex& v : mesh.vertices) {
        if (v.column == 16 && v.row == 16) {
            v.x += static_cast<float>(0.1 * view.right().x);
            v.y += static_cast<float>(0.1 * view.right().y);
            v.z += static_cast<float>(0.1 * view.right().z);
        }
    }
    const auto error = measure_error(terrain_, view, mesh);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->posts, 0u);
    EXPECT_GT(error->max_px, 0.5);
}

TEST_F(OracleTest, HasNoFigureWhereNothingIsInView) {
    camera_.pitch = geo::Degrees{90};
    const View view(camera_);
    EXPECT_FALSE(measure_error(terrain_, view, full_mesh(terrain_, view, 1)));
    EXPECT_FALSE(measure_error(terrain_, view, Mesh{}));
}

}  // namespace
}  // namespace relevo::lod
