#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/lstr/chunk_id.hpp"
#include "lod/lstr/chunk_shape.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// A vertex of a node as it is kept: its post, and the height to which it moves while the node's level gives
/// way to the coarser one.
struct ChunkVertex {
    GridPoint at;
    float H = 0;
    float coarse_H = 0;
};

/// A vertex on a side of a node.
struct SideVertex {
    std::uint32_t vertex = 0;
    bool kept = false;  ///< by the level above
};

/// The mesh of a node of level 1 or coarser, as it is kept and drawn.
struct ChunkMesh {
    ChunkId id;
    double error_m = 0;
    double moved_error_m = 0;  ///< where its vertices have moved to the coarser level
    std::vector<ChunkVertex> vertices;
    std::vector<IndexTriangle> triangles;
    std::array<std::vector<SideVertex>, kSides> sides;  ///< by column or by row, corners included
};

/// The mesh as it is kept. \param coarse  of the level above; null: it does not move
ChunkMesh finished(const ChunkShape& shape, const CoarseSurface* coarse);

/// The mesh as it is built with.
ChunkShape shape_of(const Terrain& terrain, const ChunkMesh& mesh);

}  // namespace relevo::lod
