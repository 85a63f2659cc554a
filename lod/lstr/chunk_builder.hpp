#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_id.hpp"
#include "lod/lstr/chunk_shape.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// How far levels of the quadtree may be off the ground: level 1 by first_m, each coarser one by twice as
/// much. The coarser one is drawn from twice as far, so that on the screen all are off by the same.
struct ChunkErrors {
    double first_m = 0;

    double of_level(int level) const {
        return level < 1 ? 0 : first_m * static_cast<double>(1 << (level - 1));
    }

    /// For leaves whose posts are so far apart.
    static ChunkErrors for_spacing(double spacing_m);
};

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

/// Makes the meshes of all nodes from the leaves up, a square of 1024 posts at a time: each is that of its
/// four children, of which posts are taken away as long as no post of the ground is farther off than the
/// level may be. Posts that the filter (removable_posts.hpp) finds go first, then those in the node's middle,
/// last those near its border. On the border stay the posts that border_line.hpp names, whatever is inside.
class ChunkBuilder {
  public:
    ChunkBuilder(const Terrain& terrain, const ChunkErrors& errors) : terrain_(terrain), errors_(errors) {}

    /// Takes meshes in an order that depends on the terrain alone; children come before their parent. May
    /// fail.
    using Sink = std::function<Result<void>(const ChunkMesh&)>;
    /// Of every node of level 1 or coarser that holds data.
    Result<void> build(const Sink& sink) const;

  private:
    /// Nodes of this level are built from the leaves on in one piece.
    static constexpr int kPieceLevel = 5;

    struct Piece;
    Result<Piece> build_piece(const ChunkId& id) const;
    Result<std::vector<double>> measured(const ChunkId& id, const std::vector<ChunkShape>& shapes) const;
    ChunkShape moved(const ChunkShape& shape, const CoarseSurface& coarse) const;
    Result<ChunkShape> build_above(const ChunkId& id, const Sink& sink) const;
    ChunkShape build_in(const PostField& field, const ChunkId& id, std::vector<ChunkMesh>& done) const;
    PlanarMesh refined(const PostField& field, const ChunkId& id) const;
    PlanarMesh coarsened(const PostField& field, const ChunkId& id,
                         const std::array<ChunkShape, 4>& children) const;
    ChunkShape simplified(const PostField& field, const ChunkId& id, PlanarMesh mesh) const;

    const Terrain& terrain_;
    ChunkErrors errors_;
};

}  // namespace relevo::lod
