#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/lstr/chunk_mesh.hpp"

namespace relevo::lod {

/// An edge of a node's mesh that lies on a side, between two of the side's vertices that follow each other.
struct SeamEdge {
    std::uint32_t triangle = 0;
    std::uint32_t corner = 0;  ///< the edge goes from this corner of the triangle to the next
    Side side = Side::west;
    std::uint32_t place = 0;  ///< of the first of the two in ChunkMesh::sides
    bool forward = true;      ///< the edge goes as the side's vertices follow each other
};

/// All of a mesh, triangle by triangle.
std::vector<SeamEdge> seam_edges(const std::vector<IndexTriangle>& triangles,
                                 const std::array<std::vector<SideVertex>, kSides>& sides);

/// A vertex that a finer neighbour has on a side and the node has not.
struct SeamVertex {
    std::uint32_t place = 0;  ///< of the edge that it lies on
    std::uint32_t vertex = 0;
};
/// Along each side.
using SeamVertices = std::array<std::vector<SeamVertex>, kSides>;

/// Writes three indices for each triangle of a node, of which those at a finer neighbour take in its
/// vertices: an edge becomes several, each with a triangle to the corner across. Each vertex makes one
/// triangle more. Nothing is left open, and no triangle is a sliver between two lines that are nearly the
/// same: pictures lose pixels there, since depth across a sliver cannot be told.
/// \param base  added to all indices \return what follows the last index
std::uint32_t* stitch(const std::vector<IndexTriangle>& triangles, const std::vector<SeamEdge>& edges,
                      const SeamVertices& finer, std::uint32_t base, std::uint32_t* index);

}  // namespace relevo::lod
