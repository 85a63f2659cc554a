#pragma once

#include <optional>
#include <vector>

#include "lod/ocean/ocean_mesh.hpp"

namespace relevo::lod {

/// Equation 7 of the reference: rings of radius r = a0 + a1 i^k around the eye's nadir, each of M vertices.
struct RadialShape {
    double first_m = 1;   ///< a0: of ring 0; what is inside is a fan
    double growth_m = 1;  ///< a1
    double exponent = 2;  ///< k
    int rings = 2;        ///< N
    int sectors = 16;     ///< M, a multiple of RadialGrid::kBlockCells

    double radius_m(int ring) const;
    /// The longest edge, along a circle or across rings, of the cells that begin at a ring.
    double spacing_m(int ring) const;
};

/// A shape with a0 and the last radius given (equation 8).
RadialShape radial_shape(double first_m, double last_m, double exponent, int rings, int sectors);

/// The shape of fewest vertices that keeps to a spacing from the nadir to the horizon. k is 2 where the view
/// does not span much; the more it spans, the more a higher one saves: k rings that are k / ln(reach /
/// height) too many or too few. \param most_vertices  a coarser shape is taken that keeps to it
RadialShape radial_shape_for(const SeaView& sea, const SeaSpacing& spacing, double most_vertices);

/// The radial grid of the reference, in blocks that can be culled: of kBlockCells sectors and as many rings.
/// The seam at 2 pi is closed by index: the last sector's vertices are the first's.
///
/// A vertex is (ring, sector) within its block, ring -1 being the nadir. A copy's numbers: first ring, first
/// sector. The picture's numbers: a0, a1, k, M.
class RadialGrid final : public OceanMesh {
  public:
    static constexpr int kBlockCells = 16;

    RadialGrid();
    /// Of a given shape, whatever the view.
    explicit RadialGrid(const RadialShape& shape);

    const std::vector<OceanPatch>& patches() const override { return patches_; }
    void arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                 OceanPicture& picture) const override;

  private:
    enum Patch { kBlock, kFan };
    std::vector<OceanPatch> patches_;
    std::optional<RadialShape> shape_;
};

}  // namespace relevo::lod
