#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_mesh.hpp"
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

    /// What lets a building that was interrupted go on: subtrees of 2048 posts a side and more.
    struct Subtrees {
        /// The mesh at a subtree's top, if all of it has been taken before.
        std::function<Result<std::optional<ChunkMesh>>(const ChunkId&)> find;
        /// All of a subtree has been taken but its top, which does not move yet.
        std::function<Result<void>(const ChunkMesh&)> keep;
    };

    /// Of every node of level 1 or coarser that holds data.
    Result<void> build(const Sink& sink, const Subtrees& subtrees = {}) const;

  private:
    /// Nodes of this level are built from the leaves on in one piece.
    static constexpr int kPieceLevel = 5;

    struct Piece;
    Result<Piece> build_piece(const ChunkId& id) const;
    Result<ChunkShape> build_above(const ChunkId& id, const Sink& sink, const Subtrees& subtrees) const;
    ChunkShape build_in(const PostField& field, const ChunkId& id, std::vector<ChunkMesh>& done) const;
    PlanarMesh refined(const PostField& field, const ChunkId& id) const;
    PlanarMesh coarsened(const PostField& field, const ChunkId& id,
                         const std::array<ChunkShape, 4>& children) const;
    ChunkShape simplified(const PostField& field, const ChunkId& id, PlanarMesh mesh) const;

    const Terrain& terrain_;
    ChunkErrors errors_;
};

}  // namespace relevo::lod
