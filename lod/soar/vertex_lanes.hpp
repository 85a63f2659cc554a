#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

// What is computed of many vertices at once. A *lane* is one vertex of a row; its neighbours at a given
// offset lie in consecutive lanes too (MetricTile says how), so that all loops run over consecutive numbers.
//
// Numbers that are not there, beyond the window or the grid, are NaN positions: a distance from or to them is
// NaN and never the larger one. Values are kept as floats whose last 17 bits are 0, which are those that have
// a code (scene/metric_code.hpp). All loops give the same bits with and without AVX2.

inline constexpr int kMostLanes = 64;

/// x, y and z of consecutive lanes.
struct Lanes {
    const double* x;
    const double* y;
    const double* z;
};

/// Corners of a vertex's diamond, and children, relative to it.
struct DiamondShape {
    GridPoint left;
    GridPoint right;
    std::array<GridPoint, 2> apexes;    ///< at the grid's border one of them is beyond it
    std::array<GridPoint, 4> children;  ///< unless it is of the last level
};

/// \param level, s  of the vertex and its squares, \pre column and row are right for that level
DiamondShape diamond_shape(const GridPoint& vertex, int level, int s);

/// The posts strictly inside a diamond that are no children of it. (Those on its sides are looked at for its
/// children, whose edges these are.)
class DiamondPosts {
  public:
    DiamondPosts() = default;
    DiamondPosts(const DiamondShape& shape, int s);

    static constexpr int kReach = 8;  ///< largest s

    /// Where the neighbours of a row of lanes begin: of the post dx columns to the right and dy rows below
    /// at x + row[dy + kReach] + column[dx + kReach], and so for y, z and holes.
    struct Offsets {
        std::array<std::ptrdiff_t, 2 * kReach + 1> row;
        std::array<std::ptrdiff_t, 2 * kReach + 1> column;
    };

    /// Largest squared distance between these posts and the two triangles over the diamond (left, right and
    /// an apex); negative where there is no post.
    /// \param hole  0 where there is a post, else NaN; null: everywhere
    /// \pre lanes is a multiple of 4
    void deviation2(const Lanes& posts, const double* hole, const Offsets& offsets, int lanes,
                    double* m2) const;

    struct Run {
        int row;
        int first;
        int last;
    };
    struct Triangle {
        std::array<GridPoint, 3> corner;
        std::array<double, 2> along;  ///< step of a column = along[0] (p1 - p0) + along[1] (p2 - p0)
        std::array<double, 2> down;
        std::vector<Run> runs;
    };

  private:
    std::array<Triangle, 2> triangles_;
    int steps_ = 0;  // of the edge
};

/// Of a vertex, for s from 2 to kReach; made once.
const DiamondPosts& diamond_posts(const GridPoint& vertex, int level, int s);

/// The last level: posts with nothing below them.
/// \param corners  left, right and the two apexes
/// \param holes  of the vertex and of the corners; null: no holes
void finish_last_level(const Lanes& here, const std::array<Lanes, 4>& corners,
                       const std::array<const double*, 5>* holes, int lanes, float* error, float* radius);

/// Radius of vertices with children: 0 where no child has one.
/// \param corners  must be in the sphere though a child is empty; null where none is (then the children's
/// spheres hold them)
void nest_radius(const Lanes& here, const std::array<Lanes, 4>& children,
                 const std::array<const float*, 4>& child_radii, const std::array<Lanes, 4>* corners,
                 int lanes, float* radius);

/// Squared distance of vertices from the middle of their edge, NaN in holes.
void surplus2(const Lanes& here, const Lanes& left, const Lanes& right, const double* hole, int lanes,
              double* m2);

/// The larger of an own error and the children's; 0 where the radius is.
void nest_error(const double* own_m2, const std::array<const float*, 4>& child_errors, const float* radius,
                int lanes, float* error);

}  // namespace relevo::lod
