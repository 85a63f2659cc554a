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
    int rings = 17;       ///< N, one more than a multiple of RadialGrid::kBlockCells
    int sectors = 16;     ///< M, a multiple of it

    double radius_m(int ring) const;
};

/// A shape with a0 and the last radius given (equation 8).
RadialShape radial_shape(double first_m, double last_m, double exponent, int rings, int sectors);

/// What is drawn: radii of every RadialGrid::kBlockCells-th ring, and how they go between.
struct RadialRings {
    enum class Growth {
        power,   ///< by equation 7
        factor,  ///< by a factor from ring to ring
        even,    ///< by a length from ring to ring
    };
    struct Block {
        double radius_m;  ///< of its first ring
        Growth growth;    ///< to the next block's
    };
    std::vector<Block> blocks;  ///< the last has only its first ring
    int sectors = 16;
    double exponent = 0;  ///< k, for powers

    /// The longest edge, along a circle or across rings, of the cells at a block's first ring.
    double spacing_m(std::size_t block) const;
};

RadialRings rings_of(const RadialShape& shape);

/// The rings that keep to a spacing from the nadir to the horizon: evenly far apart as far as the eye is
/// high, then each as far from the last as is allowed there. (A power of i as in equation 7 takes some
/// four times as many: its cells are of another shape at each radius.)
RadialRings rings_for(const SeaView& sea, const SeaSpacing& spacing);

/// The radial grid of the reference, in blocks that can be culled: of kBlockCells sectors and as many rings.
/// The seam at 2 pi is closed by index: the last sector's vertices are the first's.
///
/// A vertex is (ring, sector) within its block, ring -1 being the nadir. A copy's numbers: its block of
/// rings, its first sector. The picture's numbers: M, k, a0; then of each block the radius and the spacing at
/// its first ring, and the way that radii grow.
class RadialGrid final : public OceanMesh {
  public:
    static constexpr int kBlockCells = 16;
    /// Of the error, what its spacing is chosen for: there are as many sectors as the narrowest place takes,
    /// elsewhere cells are slimmer than the error's bound supposes (docs/ocean.md says what is drawn).
    static constexpr double kSlack = 1.3;

    RadialGrid();
    /// Of a given shape, whatever the view.
    explicit RadialGrid(const RadialShape& shape);

    const std::vector<OceanPatch>& patches() const override { return patches_; }
    void arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                 OceanPicture& picture) const override;

  private:
    enum Patch { kBlock, kFan };
    std::vector<OceanPatch> patches_;
    std::optional<RadialRings> rings_;
};

}  // namespace relevo::lod
