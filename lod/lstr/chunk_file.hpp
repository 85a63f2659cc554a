#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/scene/folder.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// The nodes of a scene's quadtree in one file, `chunks.bin` in the scene's folder (docs/lstr.md): each on
/// its own, compressed and with a checksum, then a table of what is known of them. It is made beside its
/// place as the nodes come and takes the place when it is whole.
class ChunkFile final : public ChunkSet {
  public:
    static constexpr const char* kName = "chunks.bin";

    /// Is there one of this very scene? (It may still be damaged.)
    static bool is_there(const Scene& scene);

    /// Makes it, in place of another. \param progress  gets the part of the nodes that is done, 0 to 1
    static Result<void> build(const Scene& scene, const Terrain& terrain,
                              const std::function<void(double)>& progress);

    /// Fails with ErrorKind::damaged where it cannot be trusted.
    static Result<ChunkFile> open(const Scene& scene, const Terrain& terrain);

    const ChunkNode* node(const ChunkId& id) const override;
    Result<std::shared_ptr<const ChunkMesh>> mesh(const ChunkId& id) const override;
    std::uint64_t bytes() const { return bytes_; }
    std::vector<ChunkId> nodes() const;

  private:
    struct Place {
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0;
        std::array<char, 16> checksum{};  // of its SHA-256
    };
    struct Entry {
        ChunkNode node;
        Place place;
    };
    ChunkFile() = default;

    std::string name_;
    Descriptor file_;
    std::uint64_t bytes_ = 0;
    double first_error_m_ = 0;
    std::map<ChunkId, Entry> entries_;
};

/// Gives a terrain its scene's quadtree: from the file, which is made first where it is not there, or of
/// another state of the scene, or in memory where the file cannot be written.
Result<void> provide_chunks(
    const Scene& scene, Terrain& terrain, const std::function<void(double)>& progress = [](double) {});

}  // namespace relevo::lod
