#pragma once

#include <optional>
#include <vector>

#include "lod/ocean/ocean_mesh.hpp"
#include "lod/ocean/projected_grid.hpp"

namespace relevo::lod {

/// The projected grid as a mesh: of some numbers of cells the fewest that keep to the spacing.
///
/// A vertex is its column and its row; a copy has no numbers but one for its presence. The picture's numbers:
/// d0 and the horizon's sin^2 of the dip, du and the radius, dv and the reach, lengths of a cell and 1 over
/// the number of cells.
class ProjectedMesh final : public OceanMesh {
  public:
    ProjectedMesh();
    /// Of so many vertices a side, whatever the view.
    explicit ProjectedMesh(int side);

    /// Does any number of cells keep to the spacing?
    static bool serves(const SeaView& sea, const SeaSpacing& spacing);

    const std::vector<OceanPatch>& patches() const override { return patches_; }
    void arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                 OceanPicture& picture) const override;

  private:
    explicit ProjectedMesh(std::vector<int> sides);

    std::vector<int> sides_;  // vertices, of each patch
    std::vector<OceanPatch> patches_;
};

}  // namespace relevo::lod
