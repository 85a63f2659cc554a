#pragma once

#include <optional>
#include <vector>

#include "lod/ocean/ocean_mesh.hpp"

namespace relevo::lod {

/// The geoclipmap of the reference: a square of blocks around the eye's nadir, all of one size; ring i is the
/// 8i blocks on the border of a square of 1 + 2i blocks a side. Blocks of `buffer_level[i]` have k / 2^level
/// cells a side (k / 2^level + 1 vertices: the reference's k / 2^level leave gaps of a cell).
///
/// Blocks of one size reach no horizon, so that squares nest: the whole of one takes the place of the inner
/// 1 + 2 hole blocks of the next, whose blocks are (1 + 2 rings) / (1 + 2 hole) times as large.
struct GeoclipmapShape {
    /// A ring of a square.
    struct Ring {
        int square = 0;
        int ring = 0;        ///< i; 0: the block in the middle
        double block_m = 0;  ///< side of its blocks
        int cells = 1;       ///< of a block, along a side
        double spacing_m() const { return block_m / cells; }
        double inner_m() const { return ring == 0 ? 0 : (ring - 0.5) * block_m; }
        double outer_m() const { return (ring + 0.5) * block_m; }
    };
    std::vector<Ring> rings;  ///< outward; spacings never get finer
};

/// D_i: blocks along a side of the square whose border is ring i (equation 5).
constexpr int blocks_a_side(int ring) {
    return 1 + 2 * ring;
}
/// Blocks of ring i.
constexpr int blocks_of_ring(int ring) {
    return ring == 0 ? 1 : 8 * ring;
}
/// T_i: cells of ring i where its blocks have `cells` a side (equation 6).
constexpr long cells_of_ring(int ring, int cells) {
    return static_cast<long>(blocks_of_ring(ring)) * cells * cells;
}

/// The reference's own: one square, k cells in its middle, the buffers' levels ring by ring.
/// \pre buffer_level[i] from 0 to log2(k), never falling
GeoclipmapShape geoclipmap_shape(int k, double block_m, const std::vector<int>& buffer_level);

/// The shape that keeps to a spacing from the nadir to the horizon.
GeoclipmapShape geoclipmap_shape_for(const SeaView& sea, const SeaSpacing& spacing);

/// Draws a shape. Vertices lie on a lattice that is fixed in the chart, so that they do not swim; towards a
/// ring's outer border they move to the next ring's lattice, and on the border they are its vertices: no edge
/// of one ring ends inside of an edge of another, and there is no crack. (The reference moves a border vertex
/// to the middle between its coarser neighbours. That is on their edge but for rounding, which leaves holes
/// of a pixel now and then.)
///
/// A vertex is a cell's corner in its block. A copy's numbers: of its first corner the column and the row in
/// the ring's lattice from its middle, and the ring. The picture's numbers: kRingNumbers a ring, see
/// shaders/ocean_geoclipmap.vert.
class Geoclipmap final : public OceanMesh {
  public:
    static constexpr int kMostCells = 64;  ///< k of shapes that it chooses itself
    static constexpr int kRingNumbers = 4;

    Geoclipmap();
    /// Of a given shape, whatever the view.
    explicit Geoclipmap(GeoclipmapShape shape);

    const std::vector<OceanPatch>& patches() const override { return patches_; }
    void arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                 OceanPicture& picture) const override;

  private:
    std::vector<OceanPatch> patches_;  // of 2^i cells a side
    std::optional<GeoclipmapShape> shape_;
};

}  // namespace relevo::lod
