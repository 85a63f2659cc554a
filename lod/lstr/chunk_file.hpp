#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_format.hpp"
#include "lod/lstr/chunk_index.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/scene/folder.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// The nodes of a scene's quadtree in one file, `chunks.bin` in the scene's folder.
class ChunkFile final : public ChunkSet {
  public:
    static constexpr const char* kName = "chunks.bin";

    /// Is there one of this very scene? (It may still be damaged.)
    static bool is_there(const Scene& scene);

    /// Fails with ErrorKind::damaged where it cannot be trusted.
    static Result<ChunkFile> open(const Scene& scene, const Terrain& terrain);

    const ChunkNode* node(const ChunkId& id) const override;
    Result<std::shared_ptr<const ChunkMesh>> mesh(const ChunkId& id) const override;

    const std::string& name() const { return name_; }
    const ChunkIndex& index() const { return index_; }
    std::uint64_t bytes() const { return bytes_; }
    ChunkErrors errors() const { return errors_; }
    bool is_replaced(const ChunkId& id) const;

  private:
    struct Entry {
        ChunkNode node;
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0;
        std::array<char, 16> checksum{};
        bool replaced = false;
    };
    explicit ChunkFile(const geo::GridFrame& frame) : index_(frame) {}

    std::string name_;
    Descriptor file_;
    std::uint64_t bytes_ = 0;
    ChunkErrors errors_;
    ChunkIndex index_;
    std::vector<Entry> entries_;
};

/// SHA-256 of a scene's description: what its chunks belong to.
Result<std::array<char, 64>> chunk_identity(const Scene& scene);

/// How far the levels of a scene's chunks may be off the ground.
ChunkErrors chunk_errors(const Terrain& terrain);

/// A node's box and figures from its row.
ChunkNode node_of(const Terrain& terrain, const ChunkId& id, const ChunkRow& row);

/// Reads so many bytes of a file. Fails with ErrorKind::damaged where there are fewer. \param name  for that
Result<std::vector<std::byte>> read_at(const Descriptor& file, std::uint64_t offset, std::uint64_t bytes,
                                       const std::string& name);

}  // namespace relevo::lod
