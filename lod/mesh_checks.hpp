#pragma once

#include "lod/mesh.hpp"

namespace relevo::lod {

/// Edges of a mesh that are split on one side only: T-vertices, where a crack could open. Judged from the
/// triangles alone: an edge used once whose halves are edges too.
int count_t_vertices(const Mesh& mesh);

/// Vertices of one post that are drawn at more than one place: a crack by rounding.
int count_torn_posts(const Mesh& mesh);

}  // namespace relevo::lod
