#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "lod/error_metric.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::lod {

/// A block of a level of a pyramid.
struct PyramidBlock {
    int level = 0;   ///< its posts are every 2^level-th of the grid
    int column = 0;  ///< in blocks of Pyramid::kBlockCells
    int row = 0;

    friend auto operator<=>(const PyramidBlock&, const PyramidBlock&) = default;
};

/// What meshes need of a block's posts.
struct VertexPosts {
    Raster<float> heights;         ///< H, metres; voids and padding filled, for meshes alone
    Raster<std::uint16_t> error;   ///< codes of the object-space error (scene/metric_code.hpp)
    Raster<std::uint16_t> radius;  ///< of the sphere's radius; 0: nothing valid below
};

/// The heights of a block's posts alone, metres.
struct BlockHeights {
    Raster<float> filled;  ///< voids and padding filled, for meshes alone
    Raster<float> data;    ///< voids and padding NaN
};

/// What pictures need of them.
struct GroundPosts {
    /// Along the row and up the column, of the unit normal of the surface, times 32767. At level 0 from the
    /// heights around; at others the mean over the posts that a post stands for.
    using Normal = std::array<std::int16_t, 2>;

    Raster<float> heights;        ///< H, metres, void and padding = NaN
    Raster<Normal> normals;       ///< 0 at voids and padding
    Raster<std::uint8_t> is_sea;  ///< 255 at posts of the class sea, else 0
};

/// The posts of a terrain at every level of detail: level k has every 2^k-th post of the padded grid, up to
/// the level that one block holds. Heights are samples, never means. Blocks share their borders.
class Pyramid {
  public:
    /// Cells a side of a block; it has one post more. A grid of fewer cells is one smaller block.
    static constexpr int kBlockCells = 256;

    virtual ~Pyramid() = default;

    virtual const geo::GridFrame& frame() const = 0;

    /// The coarsest level: its grid is one block.
    int top() const { return std::max(frame().levels() - 8, 0); }

    /// Posts of a block, padding included: always kBlockCells + 1 a side, or the whole grid's if that is
    /// less. The errors and radii of vertices that are new at the level, at odd columns or rows of its
    /// grid; at the top level those of all; what other posts have is not to be looked at.
    /// May be called from several threads. \pre the block holds a post of the data
    virtual Result<VertexPosts> read_vertices(const PyramidBlock& block, ErrorMetric metric) const = 0;

    /// Likewise.
    virtual Result<GroundPosts> read_ground(const PyramidBlock& block) const = 0;

    /// Likewise; what both others have of it, for less.
    virtual Result<BlockHeights> read_heights(const PyramidBlock& block) const;
};

}  // namespace relevo::lod
