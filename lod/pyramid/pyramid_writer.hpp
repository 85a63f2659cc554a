#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/pyramid/ground_normals.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/draft_posts.hpp"
#include "lod/scene/level_block.hpp"
#include "lod/scene/scene_writer.hpp"

namespace relevo::lod {

/// Writes the levels of a scene's pyramid, from level 1 to the coarsest (docs/scene-format.md): 1 and 2 from
/// tiles of the finest posts, the others, which lie on the lattice of every 8th post, at last from memory.
///
/// Of all tiles together it keeps 5 bytes a post of the lattice; of the four tiles that make a block of level
/// 2, what goes into it until the last of them has come.
class PyramidWriter {
  public:
    /// Posts of the scene in a box of the data, void = NaN. Called from several threads.
    using ReadPosts = std::function<Result<Posts>(const BlockGrid::Box&)>;

    /// Opens the layers of the levels, for a frame that has any. \pre fill outlives this and is finished
    static Result<PyramidWriter> open(const SceneWriter& writer, const geo::GridFrame& frame, HeightType type,
                                      const MeshHeights& fill, ReadPosts read);
    PyramidWriter(PyramidWriter&&) noexcept;
    PyramidWriter& operator=(PyramidWriter&&) noexcept;
    ~PyramidWriter();

    /// A tile of BlockGrid::of_metrics, each once. May be called from several threads.
    /// \param codes  of the tile's fine vertices, with those on its border to the next tiles, and 0 elsewhere
    /// (MetricBuilder::add_tile)
    Result<void> add_tile(int tile_column, int tile_row, const MetricRasters& codes);

    /// After all tiles. \param lattice  codes of every 8th post of the padded grid (MetricBuilder::finish)
    Result<void> finish(const MetricRasters& lattice);

    /// Where the i-th of the tiles lies in an order in which few are kept: four that make a block of level 2
    /// follow each other.
    struct Tile {
        int column;
        int row;
    };
    static Tile tile_in_order(const BlockGrid& tiles, int i);

  private:
    struct State;
    explicit PyramidWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace relevo::lod
