#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lod/static_mesh/bisection.hpp"
#include "lod/static_mesh/surface.hpp"

namespace relevo::lod {

/// How far a mesh is from the ground, measured at every post that it covers.
struct MeshError {
    double max_m = 0;
    double rms_m = 0;
    std::uint64_t posts = 0;
};

/// A conforming mesh over the ground cells of a grid of heights. Vertices are posts at their own heights;
/// every edge belongs to two triangles, or to one on the border of the ground. Voids and what is outside the
/// grid are not covered: around voids the mesh is as fine as the grid; the grid's own border needs no such
/// refinement.
///
/// Vertices are numbered row by row. Triangles come in batches that do not depend on threads, made when asked
/// for: the mesh itself is a bit for each post.
class StaticMesh {
  public:
    /// The coarsest of its kind (bisection.hpp) in which no post is farther from its triangle than
    /// max_error_m, by `surface`'s measure. \pre max_error_m >= 0; surface outlives the mesh
    template <class Surface>
    static StaticMesh build(const Surface& surface, double max_error_m);

    /// Bytes that a mesh takes at most besides the heights.
    static std::uint64_t memory_bytes(int columns, int rows);

    std::uint64_t vertices() const { return numbers_->count(); }
    std::uint64_t triangles() const { return triangles_; }
    const PostSet& vertex_posts() const { return *vertices_; }
    /// \pre the post is a vertex; fewer than 2^32 vertices
    std::uint32_t number(const GridPoint& post) const { return numbers_->of(post); }

    std::size_t batches() const { return batches_.size(); }
    /// The triangles of a batch, counter-clockwise seen from above, after what `triangles` holds.
    void append_batch(std::size_t batch, std::vector<PostTriangle>& triangles) const;

    /// Posts at a corner of a ground cell: each must be covered.
    std::uint64_t posts_to_cover() const { return cells_->covered_posts(); }

    /// Every post against the triangle that covers it, as the triangles are listed; a post on an edge counts
    /// once. The same on any number of threads.
    template <class Surface>
    MeshError measure(const Surface& surface) const;

  private:
    StaticMesh(int columns, int rows);

    void find_vertices();

    int columns_;
    int rows_;
    std::unique_ptr<const GroundCells> cells_;
    std::unique_ptr<const PostSet> splits_;
    std::unique_ptr<PostSet> vertices_;
    std::unique_ptr<const PostNumbers> numbers_;
    std::vector<BisectionTriangle> batches_;
    std::uint64_t triangles_ = 0;
};

}  // namespace relevo::lod
