#pragma once

#include <functional>

#include "geo/result.hpp"
#include "lod/lstr/chunk_builder.hpp"
#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"

namespace relevo::lod {

/// Is told the part of the nodes that is there, 0 to 1; false stops the work, which can be gone on with.
using ChunkProgress = std::function<bool(double)>;

/// Makes a scene's chunks.bin, in place of another. What an earlier call had done when it was stopped is not
/// done again, and the file is the same to the byte. Fails with ErrorKind::input where it cannot be written,
/// or was stopped, and with ErrorKind::usage where the margin is not 1e-6 to 1e5 metres.
Result<void> make_chunk_file(const Scene& scene, const Terrain& terrain, const ChunkBuilding& building,
                             const ChunkProgress& progress);

/// Gives a terrain its scene's quadtree: from the file, which is made first where it is not there, or of
/// another state of the scene, or in memory where the file cannot be written.
Result<void> provide_chunks(
    const Scene& scene, Terrain& terrain, const ChunkProgress& progress = [](double) { return true; });

}  // namespace relevo::lod
