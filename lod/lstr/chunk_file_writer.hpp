#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_format.hpp"
#include "lod/lstr/chunk_index.hpp"
#include "lod/scene/folder.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// Writes a scene's chunks beside their place, `chunks.bin.part`: the skeleton of all rows first, which is
/// filled as the nodes come. What is committed outlives a crash; who opens it again goes on from there. One
/// at a time: others wait.
class ChunkFileWriter {
  public:
    /// \param place  of the finished file
    /// \param head   what it is of: magic, scene, first_error_m, filter. Parts of something else are thrown
    /// away.
    static Result<ChunkFileWriter> open(const std::filesystem::path& place, const ChunkFileHead& head,
                                        const ChunkIndex& index);

    /// As open(), on a copy of what stands at its place.
    static Result<ChunkFileWriter> on_copy(const std::filesystem::path& place, const ChunkIndex& index);

    /// A node as it lies in the file; its row knows all but where.
    struct PackedNode {
        std::size_t place;  ///< of its row
        ChunkRow row;
        std::vector<std::byte> bytes;
    };
    /// May be called from several threads. \param flags  besides ChunkRow::kThere
    PackedNode packed(const Terrain& terrain, const ChunkMesh& mesh, std::uint32_t flags = 0) const;

    /// Puts a node, in place of one that was there.
    Result<void> put(const PackedNode& node);

    /// What was put is on the disk.
    Result<void> commit();

    /// A node that is there, as a draft or finally.
    Result<std::optional<ChunkMesh>> find(const ChunkId& id) const;
    std::size_t nodes_there() const { return there_; }

    /// Commits, and gives the file its place. \pre all nodes are there
    Result<void> finish();

    /// Another has finished it while this one waited.
    bool is_late() const { return late_; }

    /// Deletes what was written.
    void give_up();

  private:
    ChunkFileWriter(std::filesystem::path place, const ChunkIndex& index);
    Result<void> lock();
    Result<void> begin(const ChunkFileHead& head);
    bool resume(const ChunkFileHead& head);
    Result<void> write(std::uint64_t at, const void* data, std::size_t bytes);
    Error failed() const;

    std::filesystem::path place_;
    std::filesystem::path path_;
    const ChunkIndex* index_;
    Descriptor file_;
    ChunkFileHead head_;
    std::vector<ChunkRow> rows_;
    std::set<std::size_t> changed_;  // rows, since the last commit
    std::size_t there_ = 0;
    bool late_ = false;
};

}  // namespace relevo::lod
