#pragma once

#include "lod/mesh.hpp"

namespace relevo::lod {

/// Edges of a mesh that are split on one side only: T-vertices, where a crack could open. Judged from the
/// triangles alone: an edge used once whose halves are edges too. For meshes of bisection, of any part of the
/// ground.
int count_t_vertices(const Mesh& mesh);

/// Edges of a mesh of all of the ground that one triangle alone has though they lie inside the data: cracks,
/// whatever the mesh was made of. \param columns, rows  posts of the data
int count_open_edges(const Mesh& mesh, int columns, int rows);

/// Vertices of one post that are drawn at more than one place: a crack by rounding.
int count_torn_posts(const Mesh& mesh);

}  // namespace relevo::lod
