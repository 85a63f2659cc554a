#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geo/result.hpp"
#include "lod/scene/folder.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// The blocks of one layer of a scene that is being made: files in a folder of their own, written in any
/// order and from any thread. A journal beside them names each block that is whole, with its checksum, so
/// that an import which was stopped at any moment can go on from there.
class BlockStore {
  public:
    /// Opens the layer in a scene's folder, with the blocks that the journal names and whose bytes are still
    /// as it says. \param scene  outlives this
    static Result<BlockStore> open(const Folder& scene, const std::string& layer);

    /// Is the block finished (it may hold nothing, and then has no file)?
    bool has(int column, int row) const;

    /// Finishes a block. No bytes: it holds nothing and is not stored.
    Result<void> write(int column, int row, std::span<const std::byte> bytes);

    /// Finishes a block with the same bytes as another layer's, without a copy where the file system can.
    Result<void> take(int column, int row, const BlockStore& from);

    /// The bytes of a finished block, checked; empty where it holds nothing.
    Result<std::vector<std::byte>> read(int column, int row) const;

    /// All that are stored, by row and column.
    std::vector<BlockInfo> blocks() const;

    /// Deletes the journal: the layer is part of a whole scene from here on.
    Result<void> close();

    /// Deletes the layer.
    Result<void> remove();

  private:
    using Place = std::pair<int, int>;  // row, column
    BlockStore(const Folder& scene, std::string layer);

    std::string journal() const;
    Result<void> record(BlockInfo block);
    bool is_whole(const BlockInfo& block) const;

    const Folder* scene_;
    std::string layer_;
    std::unique_ptr<std::mutex> mutex_;
    std::map<Place, BlockInfo> blocks_;
};

}  // namespace relevo::lod
