#pragma once

#include <memory>

#include "geo/frame.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/raster.hpp"
#include "lod/soar/fine_metrics.hpp"
#include "lod/soar/metric_tile.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// Computes both object-space errors and the sphere radii of every vertex of the padded grid
/// (docs/design.md): saturated, nested on the stored codes, rounded up.
///
/// - bounded: largest distance in space, over the valid posts of the vertex's diamond, between the post and
///   the mesh without the vertex, compared at the same grid coordinates;
/// - incremental: distance of the vertex from the middle of the edge that it splits (Lindstrom & Pascucci).
///
/// Work goes tile by tile (the blocks of BlockGrid::of_metrics), each from its own posts and a halo of
/// MetricTile::kHalo around them, in any order. Fine vertices are finished with their tile; what a tile says
/// of the coarse ones, which lie on the lattice of every 8th post, is a maximum that is joined in memory:
/// 1/64 of the posts. So a grid of any size is read once.
class MetricBuilder {
  public:
    /// \pre the ground outlives this, its fill is finished
    MetricBuilder(const MeshGround& ground, ObjectErrors errors);
    ~MetricBuilder();

    /// Codes of the fine vertices of a tile and of the column and the row beyond it, which border it to the
    /// next ones (0 at posts of the lattice). May be called from several threads. \param heights  H of the
    /// data in MetricTile::window_of(tile), void = NaN
    MetricRasters add_tile(const BlockGrid::Box& tile, const Raster<float>& heights);

    /// Codes of the lattice: at (i, j) those of post (8 i, 8 j). To be called once, after all tiles.
    MetricRasters finish();

  private:
    struct Workspace;
    class Workspaces;

    void join_fine(const Workspace& work, const BlockGrid::Box& tile);
    void scan_finest_coarse(const Workspace& work, const BlockGrid::Box& tile, int row);
    void scan_coarse(Workspace& work, const BlockGrid::Box& tile);
    void join_error(const GridPoint& v, double m);
    double known_error(const GridPoint& v, int level);
    void finish_vertex(const GridPoint& v, int level);
    glm::dvec3 position(const GridPoint& lattice_point) const;

    MeshGround ground_;
    ObjectErrors errors_;
    int levels_;
    int lattice_levels_;  // of the hierarchy of the lattice, which is that of the grid without its fine
                          // levels
    MetricRasters lattice_;
    std::unique_ptr<Workspaces> workspaces_;
};

/// The same for a grid in memory: the codes of the whole padded grid.
/// \param heights  H of the data, metres, void = NaN
MetricRasters build_metrics(const geo::GridFrame& frame, const UndulationGrid& undulations,
                            const Raster<float>& heights, ObjectErrors errors = ObjectErrors::both);

}  // namespace relevo::lod
