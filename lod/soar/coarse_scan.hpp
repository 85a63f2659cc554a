#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "lod/soar/fine_metrics.hpp"
#include "lod/soar/metric_tile.hpp"

namespace relevo::lod {

/// A triangle of the hierarchy: corners in the grid and in space.
struct Triangle {
    std::array<GridPoint, 3> corner;
    std::array<glm::dvec3, 3> position;
};

/// How far the valid posts of one tile are from triangles much larger than the squares of fine vertices.
///
/// The largest distance is found without looking at every post. Over the part of a triangle that lies in a
/// square of 8 x 8 posts, its distance from the posts is at most that from the finer mesh at the part's
/// corners, as both are even there, and then from the finer mesh to the posts, which is what the bounded
/// error of the square's centre says. So the corners of the squares are looked at first (1/64 of the posts),
/// and then only into those squares that may hold a larger distance than is known already.
class CoarseScan {
  public:
    /// The tile's posts with the first column and row of the next tiles, to which its triangles reach.
    /// Memory is used again. \param fine  of the posts, with half size kFineHalfSize and both errors
    /// \pre both outlive what is asked below
    void prepare(const MetricTile& posts, const FineMetrics& fine, const BlockGrid::Box& box);

    /// Largest distance in space between the triangle's plane and the valid posts in it, borders included,
    /// compared at the same grid coordinates. `known_m` or something smaller where none is larger than that.
    /// \pre the corners' columns and rows are multiples of 8
    double largest_distance(const Triangle& triangle, double known_m);

  private:
    struct Plane;
    struct Columns {
        int first;
        int last;
    };
    static Columns columns_in_row(const Triangle& triangle, int row);
    double distances_in_row(const Plane& plane, int j, Columns columns, double largest);
    double scan_square(const Triangle& triangle, const Plane& plane, int i, int j, double largest2) const;

    const MetricTile* posts_ = nullptr;
    BlockGrid::Box box_;
    int across_ = 0;                 // posts of the lattice in the box
    std::vector<double> x_, y_, z_;  // of the lattice
    std::vector<double> hole_;       // 0, or NaN where there is no valid post
    std::vector<double> detail_;  // of squares: distance of the finer mesh from the posts; negative: no post
    std::vector<double> distance_;  // of the lattice from the triangle's plane
};

}  // namespace relevo::lod
