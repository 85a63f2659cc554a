#pragma once

#include <memory>

#include "geo/result.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/mesh.hpp"
#include "lod/soar/refiner.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Distances within which a level is drawn and from which it gives way to the next, by level, metres.
struct ChunkRange {
    double morph_from_m = 0;
    double until_m = 0;
};

/// A level is drawn until the next one's error is tau pixels, and far enough that neighbours in the picture
/// are at most a level apart: its farthest vertex before the next level's ends, morph and all (docs/lstr.md).
std::vector<ChunkRange> chunk_ranges(const std::vector<ChunkSet::Level>& levels, const View& view,
                                     const RefineOptions& options);

/// Draws the nodes of a quadtree at the level of detail that a view asks for: the large-scale terrain
/// renderer of the reference, with levels up to the root. Sides between nodes of different levels are closed
/// by triangles that stand on the side's straight line, between the finer node's posts and those that both
/// have: no crack, to the last bit.
class ChunkMesher {
  public:
    /// Both must outlive the mesher.
    ChunkMesher(const Terrain& terrain, const ChunkSet& chunks);
    ~ChunkMesher();

    /// The mesh of a view, valid until the next call. Fails where a read does.
    Result<const Mesh*> mesh(const View& view, const RefineOptions& options);

    /// Nodes of the last mesh.
    int drawn() const;

  private:
    struct Workshop;
    std::unique_ptr<Workshop> workshop_;
};

}  // namespace relevo::lod
