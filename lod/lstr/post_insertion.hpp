#pragma once

#include "lod/lstr/planar_mesh.hpp"
#include "lod/lstr/post_field.hpp"

namespace relevo::lod {

/// Puts posts inside a mesh, the one that is farthest off first, until none is off by more than the limit,
/// nor an edge where that can be helped: there edges are turned, or posts put beside them.
void insert_posts(const PostField& field, const GridPoint& first, int cells, double limit_m,
                  PlanarMesh& mesh);

}  // namespace relevo::lod
