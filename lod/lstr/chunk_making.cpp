#include "lod/lstr/chunk_making.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "lod/lstr/chunk_file.hpp"
#include "lod/lstr/chunk_file_writer.hpp"

namespace relevo::lod {

Result<void> make_chunk_file(const Scene& scene, const Terrain& terrain, const ChunkBuilding& building,
                             const ChunkProgress& progress) {
    // What a vertex moves by is kept in parts of it, as whole numbers.
    constexpr double kLeastMargin = 1e-6;
    constexpr double kMostMargin = 1e5;
    const double margin_m = building.errors.first_m;
    if (!(margin_m >= kLeastMargin && margin_m <= kMostMargin))
        return Error{ErrorKind::usage, fmt::format("a margin of {:.3g} m: expected {:g} to {:g} metres",
                                                   margin_m, kLeastMargin, kMostMargin)};
    const auto own = chunk_identity(scene);
    if (!own) return own.error();
    ChunkFileHead head;
    head.scene = *own;
    head.first_error_m = building.errors.first_m;
    head.filter = static_cast<std::uint64_t>(building.filter);
    const ChunkIndex index(terrain.frame());
    auto file = ChunkFileWriter::open(scene.path() / ChunkFile::kName, head, index);
    if (!file) return file.error();
    if (file->is_late() && ChunkFile::is_there(scene)) {
        file->give_up();
        return {};
    }
    const auto all = static_cast<double>(std::max<std::size_t>(index.size(), 1));
    const auto keep = [&](const ChunkMesh& mesh) -> ChunkBuilder::Writing {
        return [&, packed = file->packed(terrain, mesh)]() -> Result<void> {
            if (!progress(static_cast<double>(file->nodes_there()) / all))
                return Error{ErrorKind::input,
                             "stopped; what is done of chunks.bin is kept, and gone on with"};
            return file->put(packed);
        };
    };
    const ChunkBuilder::Subtrees subtrees{[&](const ChunkId& id) { return file->find(id); },
                                          [&](const ChunkMesh& top) -> Result<void> {
                                              const auto packed =
                                                  file->packed(terrain, top, ChunkRow::kDraft);
                                              if (auto done = file->put(packed); !done) return done;
                                              return file->commit();
                                          }};
    if (auto done = ChunkBuilder(terrain, building).build(keep, subtrees); !done) return done;
    return file->finish();
}

Result<void> provide_chunks(const Scene& scene, Terrain& terrain, const ChunkProgress& progress) {
    if (!ChunkFile::is_there(scene)) {
        bool stopped = false;
        const auto built = make_chunk_file(scene, terrain, {chunk_errors(terrain)}, [&](double part) {
            stopped = !progress(part);
            return !stopped;
        });
        if (!built) {
            if (stopped || built.error().kind != ErrorKind::input) return built.error();
            auto chunks = MemoryChunks::build(terrain, chunk_errors(terrain));
            if (!chunks) return chunks.error();
            terrain.use_chunks(std::make_shared<const MemoryChunks>(*std::move(chunks)));
            return {};
        }
    }
    auto chunks = ChunkFile::open(scene, terrain);
    if (!chunks) return chunks.error();
    terrain.use_chunks(std::make_shared<const ChunkFile>(*std::move(chunks)));
    return {};
}

}  // namespace relevo::lod
