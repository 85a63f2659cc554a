#pragma once

#include "lod/soar/full_mesh.hpp"
#include "lod/soar/refiner.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// Makes the mesh that a view asks for, by the method that it asks for.
class Mesher {
  public:
    /// The terrain must outlive the mesher.
    explicit Mesher(const lod::Terrain& terrain) : terrain_(terrain), refiner_(terrain) {}

    /// Valid until the next call.
    const lod::Mesh& mesh(const lod::View& view, const ViewState& state) {
        if (state.method == Method::full) {
            full_ = lod::full_mesh(terrain_, view, state.exaggeration);
            return full_;
        }
        return refiner_.refine(
            view,
            {.tau_px = state.tau_px, .morph = state.morph, .exaggeration = state.exaggeration, .cull = true});
    }

  private:
    const lod::Terrain& terrain_;
    lod::Refiner refiner_;
    lod::Mesh full_;
};

}  // namespace relevo::viewer
