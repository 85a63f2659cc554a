#include "lod/static_mesh/static_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lod/static_mesh/post_ownership.hpp"
#include "lod/static_mesh/post_rows.hpp"

namespace relevo::lod {
namespace {

/// Longest edge of a batch's triangle, in posts: some thousands of triangles at the most.
constexpr int kBatchSide = 64;

bool is_batch(const BisectionTriangle& t) {
    return std::max(std::abs(t.left.column - t.right.column), std::abs(t.left.row - t.right.row)) <=
           kBatchSide;
}

/// Calls leaf(triangle) for the triangles below one that are not split, and for those at which
/// stop(triangle).
template <class Stop, class Leaf>
void for_each_leaf(const BisectionTriangle& root, const PostSet& splits, const Stop& stop, const Leaf& leaf) {
    std::vector<BisectionTriangle> open{root};
    while (!open.empty()) {
        const BisectionTriangle t = open.back();
        open.pop_back();
        if (t.is_finest() || stop(t) || !splits.contains(t.middle())) {
            leaf(t);
            continue;
        }
        open.push_back(t.right_half());
        open.push_back(t.left_half());
    }
}

}  // namespace

StaticMesh::StaticMesh(int columns, int rows) : columns_(columns), rows_(rows) {}

std::uint64_t StaticMesh::memory_bytes(int columns, int rows) {
    if (columns < 2 || rows < 2) return 0;
    const BisectionRoots roots(columns, rows);
    const auto x = static_cast<std::uint64_t>(columns);
    const auto y = static_cast<std::uint64_t>(rows);
    return PostSet::memory_bytes(static_cast<std::uint64_t>(roots.columns()),
                                 static_cast<std::uint64_t>(roots.rows())) +
           2 * PostSet::memory_bytes(x, y) + PostNumbers::memory_bytes(x, y);
}

template <class Surface>
StaticMesh StaticMesh::build(const Surface& surface, double max_error_m) {
    const Raster<float>& heights = surface.heights();
    StaticMesh mesh(heights.columns(), heights.rows());
    mesh.cells_ = std::make_unique<const GroundCells>(heights);
    mesh.vertices_ = std::make_unique<PostSet>(heights.columns(), heights.rows());
    if (mesh.cells_->count() > 0) {
        const BisectionRoots roots(heights.columns(), heights.rows());
        mesh.splits_ =
            std::make_unique<const PostSet>(choose_splits(roots, surface, *mesh.cells_, max_error_m));
        for (const BisectionTriangle& root : roots.triangles())
            for_each_leaf(root, *mesh.splits_, is_batch, [&](const auto& t) { mesh.batches_.push_back(t); });
        mesh.find_vertices();
    }
    mesh.numbers_ = std::make_unique<const PostNumbers>(*mesh.vertices_);
    return mesh;
}

void StaticMesh::find_vertices() {
    std::vector<std::uint32_t> counts(batches_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, batches_.size()),
                      [&](const tbb::blocked_range<std::size_t>& some) {
                          std::vector<PostTriangle> triangles;
                          for (std::size_t i = some.begin(); i < some.end(); ++i) {
                              triangles.clear();
                              append_batch(i, triangles);
                              counts[i] = static_cast<std::uint32_t>(triangles.size());
                              for (const PostTriangle& t : triangles)
                                  for (const GridPoint& p : t) vertices_->add(p);
                          }
                      });
    std::size_t kept = 0;  // batches that hold something
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        triangles_ += counts[i];
        if (counts[i] > 0) batches_[kept++] = batches_[i];
    }
    batches_.resize(kept);
}

void StaticMesh::append_batch(std::size_t batch, std::vector<PostTriangle>& triangles) const {
    const auto go_on = [](const BisectionTriangle&) { return false; };
    for_each_leaf(batches_[batch], *splits_, go_on, [&](const BisectionTriangle& t) {
        // No leaf reaches both into ground and into other cells.
        if (cells_->share(t) != GroundCells::Share::all) return;
        for (const PostTriangle& part : inner_part(t, columns_, rows_)) triangles.push_back(part);
    });
}

namespace {

struct Sums {
    double max_m = 0;
    double squares = 0;
    std::uint64_t posts = 0;
};

template <class Plane>
void measure_triangle(const PostTriangle& t, const Plane& plane, const GroundCells& cells, Sums& sums) {
    const auto [north, south] = std::minmax({t[0].row, t[1].row, t[2].row});
    for_each_row(t, [&, north = north, south = south](int row, int first, int last) {
        for (int column = first; column <= last; ++column) {
            const GridPoint post{column, row};
            const bool corner = post == t[0] || post == t[1] || post == t[2];
            const double error = corner ? 0 : plane.at(column, row);
            sums.max_m = std::max(sums.max_m, error);
            const bool inside = column != first && column != last && row != north && row != south;
            if (!inside && !owns(t, post, cells)) continue;
            sums.squares += error * error;
            ++sums.posts;
        }
        return true;
    });
}

}  // namespace

template <class Surface>
MeshError StaticMesh::measure(const Surface& surface) const {
    // Summed up in the batches' order, so that the result does not depend on threads.
    std::vector<Sums> sums(batches_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, batches_.size()),
                      [&](const tbb::blocked_range<std::size_t>& some) {
                          std::vector<PostTriangle> triangles;
                          for (std::size_t i = some.begin(); i < some.end(); ++i) {
                              triangles.clear();
                              append_batch(i, triangles);
                              for (const PostTriangle& t : triangles)
                                  measure_triangle(t, typename Surface::Plane(surface, t), *cells_, sums[i]);
                          }
                      });
    MeshError error;
    double squares = 0;
    for (const Sums& sum : sums) {
        error.max_m = std::max(error.max_m, sum.max_m);
        squares += sum.squares;
        error.posts += sum.posts;
    }
    if (error.posts > 0) error.rms_m = std::sqrt(squares / static_cast<double>(error.posts));
    return error;
}

template StaticMesh StaticMesh::build(const HeightSurface&, double);
template StaticMesh StaticMesh::build(const SpaceSurface&, double);
template MeshError StaticMesh::measure(const HeightSurface&) const;
template MeshError StaticMesh::measure(const SpaceSurface&) const;

}  // namespace relevo::lod
