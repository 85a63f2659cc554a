#pragma once

#include <memory>

#include "lod/mesh.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// What to draw of a terrain.
struct RefineOptions {
    double tau_px = 1;        ///< the guarantee: no point of the picture is farther off than this (bounded metric)
    bool morph = true;        ///< vertices move in continuously over a band of errors, at a price in triangles
    double exaggeration = 1;  ///< h = N + exaggeration H
    bool cull = true;         ///< leave out what is outside the picture
};

/// View-dependent refinement by longest-edge bisection (Lindstrom & Pascucci 2002, "Terrain simplification
/// simplified"), with the bounds and the morph of docs/design.md. Keeps its buffers between frames: after the first
/// few, a frame allocates nothing.
class Refiner {
  public:
    explicit Refiner(const Terrain& terrain);
    ~Refiner();
    Refiner(Refiner&&) noexcept;

    /// The mesh for one view, valid until the next call.
    const Mesh& refine(const View& view, const RefineOptions& options);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Every triangle of the full-resolution data, whatever the view (`--lod full`).
Mesh full_mesh(const Terrain& terrain, const View& view, double exaggeration);

}  // namespace relevo::lod
