#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_errors.hpp"
#include "lod/lstr/chunk_mesh.hpp"
#include "lod/lstr/chunk_shape.hpp"
#include "lod/lstr/removable_posts.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// What nodes are built by.
struct ChunkBuilding {
    ChunkErrors errors;
    RemovalTest filter = RemovalTest::pairs;
    /// Nodes up to this level are built from all posts, a node of this level in one piece.
    int piece_level = 5;
};

/// Makes the meshes of all nodes from the leaves up (chunk_simplifier.hpp), on all cores.
class ChunkBuilder {
  public:
    ChunkBuilder(const Terrain& terrain, const ChunkBuilding& building)
        : terrain_(terrain), building_(building) {}

    /// What is left to do with a mesh when its turn comes. May fail.
    using Writing = std::function<Result<void>()>;
    /// Takes meshes from several threads, in any order; what it returns is called by one thread at a time, in
    /// an order that depends on the terrain alone: children before their parent.
    using Sink = std::function<Writing(const ChunkMesh&)>;

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
    /// Bounds the memory: some 30 MiB each.
    static constexpr std::size_t kPiecesAhead = 8;

    struct Piece;
    struct Step;
    Result<void> plan(const ChunkId& id, const Subtrees& subtrees, std::vector<Step>& steps) const;
    Result<Piece> build_piece(const ChunkId& id, const Sink& sink) const;
    Result<ChunkShape> build_above(const ChunkId& id, const std::array<ChunkShape, 4>& children,
                                   const Sink& sink) const;
    ChunkShape build_in(const PostField& field, const PostSet& removable, const ChunkId& id, const Sink& sink,
                        std::vector<Writing>& done) const;

    const Terrain& terrain_;
    ChunkBuilding building_;
};

}  // namespace relevo::lod
