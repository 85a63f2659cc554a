#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/lstr/chunk_selector.hpp"

namespace relevo::lod {

/// What a node takes in along the sides at which finer nodes are drawn.
struct FinerSides {
    /// That the node has not; their indices follow those of the node's own.
    std::vector<PlacedChunk::Vertex> vertices;
    SeamVertices seams;
};
FinerSides finer_sides(const SelectedChunk& node);

/// How many vertices that are. Each makes one triangle more.
std::size_t count_finer(const SelectedChunk& node);

/// Writes three indices for each triangle of a node as it is drawn.
/// \param base  added to all of them
void write_triangles(const SelectedChunk& node, const SeamVertices& seams, std::uint32_t base,
                     std::uint32_t* index);

}  // namespace relevo::lod
