#pragma once

#include <memory>
#include <optional>

#include "geo/result.hpp"
#include "lod/lstr/chunk_selector.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/lstr/chunk_store.hpp"
#include "lod/mesh.hpp"
#include "lod/soar/refiner.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

struct ChunkOptions {
    ChunkStoreOptions store;
    SelectionOptions selection;
};

/// Draws the nodes of a quadtree at the level of detail that a view asks for: the large-scale terrain
/// renderer of the reference, with levels up to the root. A node takes in what finer neighbours have on its
/// sides: no crack, to the last bit.
class ChunkMesher {
  public:
    /// Both must outlive the mesher.
    ChunkMesher(const Terrain& terrain, const ChunkSet& chunks, const ChunkOptions& options = {});
    ~ChunkMesher();

    /// The mesh of a view of what is in memory; what is missing, and what is near, is read in the background.
    /// Valid until the next call. Fails where the root cannot be read.
    Result<const Mesh*> mesh(const View& view, const RefineOptions& options);

    /// Of all that the view asks for: waits for what is missing, has no room too small, and nothing fades in.
    /// Fails where a read does.
    Result<const Mesh*> whole_mesh(const View& view, const RefineOptions& options);

    SelectionOptions& selection();

    struct Figures {
        int drawn_nodes = 0;  ///< of the last mesh
        bool fading = false;  ///< are nodes still coming in?
        ChunkStore::Figures store;
    };
    Figures figures() const;

    /// The first read in the background that failed: the ground is drawn as coarse as what is there.
    std::optional<Error> failure() const;

  private:
    struct Workshop;
    std::unique_ptr<Workshop> workshop_;
};

}  // namespace relevo::lod
