#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/lstr/chunk_id.hpp"
#include "lod/lstr/planar_mesh.hpp"

namespace relevo::lod {

/// The mesh of a node of level 1 or coarser. (A leaf is all of its posts.)
struct ChunkShape {
    ChunkId id;
    std::vector<PlacedPost> posts;  ///< row by row
    std::vector<IndexTriangle> triangles;
    /// How far valid posts are from the triangle's point at the same grid coordinates, at most, metres.
    double error_m = 0;

    /// Places of the posts on a side, by column or by row.
    std::vector<std::uint32_t> side(Side side) const;
};

/// Row by row: the order of a shape's posts.
bool is_before(const PlacedPost& a, const PlacedPost& b);

/// Of a post in a list in that order.
std::uint32_t place_of(const std::vector<PlacedPost>& posts, const PlacedPost& post);

/// Where a coarser mesh is: what its finer vertices move to.
class CoarseSurface {
  public:
    /// \param shape  must outlive this
    explicit CoarseSurface(const ChunkShape& shape);

    /// Has the coarser mesh this vertex?
    bool has(const GridPoint& at) const;

    /// H that brings a post of the node's square closest to the coarser mesh there. On the node's sides it
    /// depends on what is on the side alone.
    float height(const PlacedPost& post) const;

  private:
    const ChunkShape* shape_;
    int bins_;                                           // a side
    int bin_cells_;                                      // of a bin's side
    std::vector<std::vector<std::uint32_t>> triangles_;  // by bin
    std::array<std::vector<std::uint32_t>, kSides> sides_;
};

}  // namespace relevo::lod
