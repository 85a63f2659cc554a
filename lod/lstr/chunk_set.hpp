#pragma once

#include <map>
#include <memory>

#include "geo/result.hpp"
#include "lod/lstr/chunk_box.hpp"
#include "lod/lstr/chunk_builder.hpp"

namespace relevo::lod {

/// What is known of a node without its mesh.
struct ChunkNode {
    ChunkBox box;
    double error_m = 0;
    double moved_error_m = 0;
    double most_H_m = 0;  ///< largest |H| of its vertices
    std::uint32_t vertices = 0;
};

/// The nodes of a terrain, and their meshes.
class ChunkSet {
  public:
    virtual ~ChunkSet() = default;

    /// Of nodes of level 1 or coarser; null: the node holds no data.
    virtual const ChunkNode* node(const ChunkId& id) const = 0;

    /// \pre the node is there. May be called from several threads.
    virtual Result<std::shared_ptr<const ChunkMesh>> mesh(const ChunkId& id) const = 0;
};

/// All of them in memory: for tests, and for terrains that are small.
class MemoryChunks final : public ChunkSet {
  public:
    static Result<MemoryChunks> build(const Terrain& terrain, const ChunkErrors& errors);

    const ChunkNode* node(const ChunkId& id) const override;
    Result<std::shared_ptr<const ChunkMesh>> mesh(const ChunkId& id) const override;

  private:
    struct Entry {
        ChunkNode node;
        std::shared_ptr<const ChunkMesh> mesh;
    };
    std::map<ChunkId, Entry> entries_;
};

/// Of a mesh that was built.
ChunkNode chunk_node(const Terrain& terrain, const ChunkMesh& mesh);

}  // namespace relevo::lod
