#pragma once

#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_shape.hpp"
#include "lod/lstr/post_field.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// The largest error of a mesh in a field's square, metres, with what rounding may hide.
double error_in(const PostField& field, const ChunkShape& shape);

/// The errors of meshes that lie in a node against all of its posts, which are read a square at a time.
Result<std::vector<double>> errors_in(const Terrain& terrain, const ChunkId& id,
                                      const std::vector<ChunkShape>& shapes);

/// A mesh with its vertices where the coarser level is.
ChunkShape moved(const Terrain& terrain, const ChunkShape& shape, const CoarseSurface& coarse);

}  // namespace relevo::lod
