#pragma once

#include <memory>
#include <optional>

#include "geo/result.hpp"
#include "lod/lstr/chunk_picture.hpp"
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

    /// What shows a view, of what is in memory; what is missing, and what is near, is read in the background.
    /// Fails where the root cannot be read.
    Result<ChunkPicture> picture(const View& view, const RefineOptions& options);

    /// Of all that the view asks for: waits for what is missing, has no room too small, and nothing fades in.
    /// Fails where a read does.
    Result<ChunkPicture> whole_picture(const View& view, const RefineOptions& options);

    /// The last picture as one mesh. Valid until the next call.
    /// \param view  that the picture was made for
    const Mesh& assemble(const View& view, const ChunkPicture& picture);

    Result<const Mesh*> mesh(const View& view, const RefineOptions& options) {
        return assembled(view, picture(view, options));
    }
    Result<const Mesh*> whole_mesh(const View& view, const RefineOptions& options) {
        return assembled(view, whole_picture(view, options));
    }

    SelectionOptions& selection();

    struct Figures {
        int drawn_nodes = 0;  ///< of the last picture
        bool fading = false;  ///< are nodes still coming in?
        ChunkStore::Figures store;
    };
    Figures figures() const;

    /// The first read in the background that failed: the ground is drawn as coarse as what is there.
    std::optional<Error> failure() const;

  private:
    Result<const Mesh*> assembled(const View& view, const Result<ChunkPicture>& picture) {
        if (!picture) return picture.error();
        return &assemble(view, *picture);
    }

    struct Workshop;
    std::unique_ptr<Workshop> workshop_;
};

}  // namespace relevo::lod
