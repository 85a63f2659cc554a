#include "lod/mesh_checks.hpp"

#include <gtest/gtest.h>

namespace relevo::lod {
namespace {

MeshVertex vertex(int column, int row) {
    return {static_cast<float>(column), static_cast<float>(row), 0, static_cast<std::uint16_t>(column),
            static_cast<std::uint16_t>(row)};
}

// A square of two triangles: watertight.
const Mesh kSquare{{vertex(0, 0), vertex(4, 0), vertex(4, 4), vertex(0, 4)}, {0, 2, 1, 2, 0, 3}};

TEST(MeshChecks, FindNothingInAWatertightMesh) {
    EXPECT_EQ(count_t_vertices(kSquare), 0);
    EXPECT_EQ(count_torn_posts(kSquare), 0);
}

TEST(MeshChecks, FindATVertex) {
    Mesh mesh = kSquare;
    mesh.vertices.push_back(vertex(2, 2));
    mesh.indices = {0, 2, 1, 2, 4, 3, 4, 0, 3};  // the diagonal is split on one side alone
    EXPECT_EQ(count_t_vertices(mesh), 1);
}

TEST(MeshChecks, FindAnOpenEdge) {
    EXPECT_EQ(count_open_edges(kSquare, 5, 5), 0);
    EXPECT_EQ(count_open_edges(kSquare, 6, 5), 1) << "the right side is not the data's border";
    Mesh mesh = kSquare;
    mesh.vertices.push_back(vertex(1, 1));
    mesh.indices = {0, 2, 1, 2, 4, 3, 4, 0, 3};  // the diagonal is split on one side alone, not at its middle
    EXPECT_EQ(count_open_edges(mesh, 5, 5), 3);
    mesh.indices.insert(mesh.indices.end(), {0, 4, 2});
    EXPECT_EQ(count_open_edges(mesh, 5, 5), 0) << "closed by a triangle without an area";
}

TEST(MeshChecks, FindAPostDrawnTwice) {
    Mesh mesh = kSquare;
    mesh.vertices.push_back(vertex(2, 2));
    mesh.vertices.push_back(vertex(2, 2));
    EXPECT_EQ(count_torn_posts(mesh), 0) << "twice at one place is no crack";
    mesh.vertices.back().z = 1e-3f;
    EXPECT_EQ(count_torn_posts(mesh), 1);
}

}  // namespace
}  // namespace relevo::lod
