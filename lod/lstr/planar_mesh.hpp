#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lod/lstr/post_field.hpp"

namespace relevo::lod {

/// Corners of a triangle by their places in a list of posts, counter-clockwise seen from above.
using IndexTriangle = std::array<std::uint32_t, 3>;

/// A mesh over a square of posts from which vertices can be taken away. What is taken away leaves a polygon,
/// which is cut into triangles anew: the mesh covers the square at any time, and no triangle turns over.
class PlanarMesh {
  public:
    /// \param first, cells  the square: what lies on its sides is border
    PlanarMesh(std::vector<PlacedPost> posts, const std::vector<IndexTriangle>& triangles,
               const GridPoint& first, int cells);

    std::size_t vertices() const { return posts_.size(); }  ///< the taken ones too
    const PlacedPost& post(std::uint32_t vertex) const { return posts_[vertex]; }
    bool is_alive(std::uint32_t vertex) const { return !rings_[vertex].empty(); }
    bool on_border(std::uint32_t vertex) const { return on_border_[vertex]; }
    bool is_border(const GridPoint& at) const {
        return at.column == first_.column || at.column == first_.column + cells_ || at.row == first_.row ||
               at.row == first_.row + cells_;
    }

    /// The triangles that would be where a vertex is now. Valid until the next plan.
    struct Plan {
        std::vector<std::uint32_t> polygon;    // the vertex's neighbours
        std::vector<IndexTriangle> triangles;  // of places in the polygon
    };
    /// False where the polygon cannot be cut: never for a border vertex with neighbours on one straight side,
    /// or one inside. \pre the vertex is alive, no corner of the square
    bool plan(std::uint32_t vertex, Plan& plan) const;

    /// Other triangles in the same polygon: all with one of its corners, if they are such.
    bool plan_fan(std::uint32_t corner, Plan& plan) const;

    PlacedTriangle placed(const Plan& plan, const IndexTriangle& triangle) const {
        const auto at = [&](int i) { return &posts_[plan.polygon[triangle[static_cast<std::size_t>(i)]]]; };
        return {at(0), at(1), at(2)};
    }

    /// Is an edge between two places of the planned polygon not one of the mesh's already?
    bool is_inner(const Plan& plan, std::uint32_t a, std::uint32_t b) const {
        const auto count = static_cast<std::uint32_t>(plan.polygon.size());
        return (a + 1) % count != b && (b + 1) % count != a;
    }

    /// Takes the vertex away as planned.
    void take(std::uint32_t vertex, const Plan& plan);

    /// Is the triangle still part of the mesh?
    bool has(const IndexTriangle& triangle) const;

    /// Adds a post inside a triangle or on one of its edges, which is not on the border. The triangles around
    /// it are those of its ring. \pre it is no corner
    std::uint32_t insert(const PlacedPost& post, const IndexTriangle& triangle);

    /// The two triangles on an edge as they would be with the other diagonal of their square. Nothing on the
    /// border, and where the square is not convex. \pre the edge is in the mesh
    std::optional<std::array<IndexTriangle, 2>> flipped(std::uint32_t a, std::uint32_t b) const;
    /// Puts them there. \param triangles  what flipped() gave
    void flip(std::uint32_t a, std::uint32_t b, const std::array<IndexTriangle, 2>& triangles);

    /// Flips edges until none around a vertex that was just put there has a fourth corner in its triangles'
    /// circles (Lawson 1977). What changes are triangles of its ring.
    void legalize(std::uint32_t vertex);

    /// Neighbours, counter-clockwise; of a border vertex from one side to the other.
    const std::vector<std::uint32_t>& ring(std::uint32_t vertex) const { return rings_[vertex]; }

    /// Of the vertices that are left.
    std::vector<IndexTriangle> triangles() const;

  private:
    std::vector<PlacedPost> posts_;
    std::vector<std::vector<std::uint32_t>> rings_;
    std::vector<bool> on_border_;
    GridPoint first_;
    int cells_;
};

}  // namespace relevo::lod
