#include "lod/static_mesh/grid_triangle.hpp"

#include <cstddef>
#include <cstdlib>
#include <utility>

namespace relevo::lod {
namespace {

/// A convex polygon between posts: a triangle cut by two lines has at most five corners.
struct Polygon {
    std::array<GridPoint, 5> corners{};
    int count = 0;

    void add(const GridPoint& p) { corners[static_cast<std::size_t>(count++)] = p; }
    const GridPoint& at(int i) const { return corners[static_cast<std::size_t>(i)]; }
};

/// What of a polygon has a coordinate of at most `last`. Edges that cross it do so at a post: the other
/// coordinate changes by 0, by the same, or by the opposite.
Polygon cut(const Polygon& polygon, int GridPoint::*coordinate, int GridPoint::*other, int last) {
    Polygon kept;
    for (int i = 0; i < polygon.count; ++i) {
        const GridPoint& a = polygon.at(i);
        const GridPoint& b = polygon.at((i + 1) % polygon.count);
        const bool a_inside = a.*coordinate <= last;
        const bool b_inside = b.*coordinate <= last;
        if (a_inside) kept.add(a);
        const bool touches = a.*coordinate == last || b.*coordinate == last;
        if (a_inside == b_inside || touches) continue;
        GridPoint crossing;
        crossing.*coordinate = last;
        const int along = last - a.*coordinate;
        const int rise = b.*other - a.*other;
        const int run = b.*coordinate - a.*coordinate;
        crossing.*other = a.*other + (rise == 0 ? 0 : rise == run ? along : -along);
        kept.add(crossing);
    }
    return kept;
}

}  // namespace

InnerPart inner_part(const BisectionTriangle& triangle, int columns, int rows) {
    PostTriangle corners{triangle.left, triangle.right, triangle.apex};
    if (turn(corners[0], corners[1], corners[2]) < 0) std::swap(corners[0], corners[1]);
    InnerPart part;
    bool inside = true;
    for (const GridPoint& p : corners) inside = inside && p.column < columns && p.row < rows;
    if (inside) {
        part.triangles[part.count++] = corners;
        return part;
    }
    Polygon polygon{{corners[0], corners[1], corners[2]}, 3};
    polygon = cut(polygon, &GridPoint::column, &GridPoint::row, columns - 1);
    polygon = cut(polygon, &GridPoint::row, &GridPoint::column, rows - 1);
    // A fan around the first corner. Three corners in a line are left out with the triangle they would make.
    for (int i = 1; i + 1 < polygon.count; ++i) {
        const PostTriangle piece{polygon.at(0), polygon.at(i), polygon.at(i + 1)};
        if (turn(piece[0], piece[1], piece[2]) > 0)
            part.triangles[static_cast<std::size_t>(part.count++)] = piece;
    }
    return part;
}

}  // namespace relevo::lod
