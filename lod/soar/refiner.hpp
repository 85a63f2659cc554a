#pragma once

#include <vector>

#include "lod/mesh.hpp"
#include "lod/soar/vertex_cache.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// What to draw of a terrain.
struct RefineOptions {
    double tau_px = 1;  ///< the guarantee: no point of the picture is farther off than this (bounded metric)
    bool morph = true;  ///< vertices move in continuously over a band of errors, at a price in triangles
    double exaggeration = 1;  ///< h = N + exaggeration H
    bool cull = true;         ///< leave out what is outside the picture
};

/// View-dependent refinement by longest-edge bisection (Lindstrom & Pascucci 2002, "Terrain simplification
/// simplified: a general framework for view-dependent out-of-core visualization"), with the bounds and the
/// morph of docs/design.md. Keeps its buffers between frames: after the first few, a frame allocates nothing.
class Refiner {
  public:
    /// The terrain must outlive the refiner.
    explicit Refiner(const Terrain& terrain);

    /// The mesh for one view, valid until the next call. \pre tau_px > 0, exaggeration >= 0
    const Mesh& refine(const View& view, const RefineOptions& options);

  private:
    const Terrain& terrain_;
    Mesh mesh_;
    VertexCache cache_;
};

}  // namespace relevo::lod
