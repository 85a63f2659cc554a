#pragma once

#include <limits>
#include <memory>

#include "geo/result.hpp"
#include "lod/mesh.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// What to draw of a terrain.
struct RefineOptions {
    double tau_px = 1;  ///< the guarantee: no point of the picture is farther off than this (bounded metric)
    bool morph = true;  ///< vertices move in continuously over a band of errors, at a price in triangles
    double exaggeration = 1;  ///< h = N + exaggeration H
    bool cull = true;         ///< leave out what is outside the picture
    bool parallel = true;     ///< on all cores
    /// Tiles and nodes that begin farther away are left out, metres.
    double view_distance_m = std::numeric_limits<double>::infinity();
};

/// View-dependent refinement by longest-edge bisection (Lindstrom & Pascucci 2002, "Terrain simplification
/// simplified: a general framework for view-dependent out-of-core visualization"), with the bounds and the
/// morph of docs/design.md, over the tiles that are in memory. Keeps its buffers between frames: after the
/// first few, a frame allocates nothing.
class Refiner {
  public:
    /// The terrain must outlive the refiner.
    explicit Refiner(const Terrain& terrain);
    ~Refiner();

    /// The mesh for one view of what is in memory, valid until the next call; what is missing is told to the
    /// tile store. \pre tau_px > 0, exaggeration >= 0
    const Mesh& refine(const View& view, const RefineOptions& options);

    /// Asks the tile store for what a view will need that is soon to come.
    void look_ahead(const View& view, const RefineOptions& options);

    /// As refine(), of all that the view needs: waits for what is missing. Fails where a read does, or where
    /// the tiles do not fit in their memory.
    Result<const Mesh*> refine_whole(const View& view, const RefineOptions& options);

  private:
    struct Workshop;
    std::unique_ptr<Workshop> workshop_;
};

}  // namespace relevo::lod
