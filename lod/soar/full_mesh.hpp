#pragma once

#include "lod/mesh.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Every triangle of the full-resolution data, whatever the view (`--lod full`): two a cell whose four posts
/// are valid, along the diagonals of the finest level of the refinement.
Mesh full_mesh(const Terrain& terrain, const View& view, double exaggeration);

}  // namespace relevo::lod
