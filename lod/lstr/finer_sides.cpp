#include "lod/lstr/finer_sides.hpp"

#include <algorithm>
#include <array>

namespace relevo::lod {

namespace {

constexpr std::array<Side, kSides> kOpposite{Side::east, Side::west, Side::south, Side::north};

/// Calls visit(vertex) for those of the finer nodes across a side that the node has not, along the side.
template <class Visit>
void for_each_finer(const ChunkGroup& across, Side side, const Visit& visit) {
    const Side facing = kOpposite[static_cast<std::size_t>(side)];
    constexpr std::array<std::array<std::size_t, 2>, kSides> kFacing{{{0, 2}, {1, 3}, {0, 1}, {2, 3}}};
    for (const std::size_t child : kFacing[static_cast<std::size_t>(facing)]) {
        const PlacedChunk& node = across.children[child];
        for (const SideVertex& on : node.sides[static_cast<std::size_t>(facing)]) {
            if (!on.kept) visit(node.vertices[on.vertex]);
        }
    }
}

}  // namespace

FinerSides finer_sides(const SelectedChunk& node) {
    FinerSides found;
    const PlacedChunk& chunk = *node.chunk;
    auto next = static_cast<std::uint32_t>(chunk.vertices.size());
    for (std::size_t side = 0; side < kSides; ++side) {
        if (node.finer[side] == nullptr) continue;
        const bool along_row =
            static_cast<Side>(side) == Side::north || static_cast<Side>(side) == Side::south;
        const auto along = [&](const PlacedChunk::Vertex& v) { return along_row ? v.column : v.row; };
        std::uint32_t edge = 0;
        for_each_finer(*node.finer[side], static_cast<Side>(side), [&](const PlacedChunk::Vertex& finer) {
            while (along(chunk.vertices[chunk.sides[side][edge + 1].vertex]) < along(finer)) ++edge;
            found.vertices.push_back(finer);
            found.seams[side].push_back({edge, next++});
        });
    }
    return found;
}

std::size_t count_finer(const SelectedChunk& node) {
    std::size_t count = 0;
    for (std::size_t side = 0; side < kSides; ++side) {
        if (node.finer[side] != nullptr)
            for_each_finer(*node.finer[side], static_cast<Side>(side),
                           [&](const PlacedChunk::Vertex&) { ++count; });
    }
    return count;
}

void write_triangles(const SelectedChunk& node, const SeamVertices& seams, std::uint32_t base,
                     std::uint32_t* index) {
    const std::vector<IndexTriangle>& triangles = *node.chunk->triangles;
    const bool stitched =
        std::any_of(seams.begin(), seams.end(), [](const auto& on_side) { return !on_side.empty(); });
    if (stitched) {
        stitch(triangles, node.chunk->seams, seams, base, index);
        return;
    }
    std::transform(&triangles.front()[0], &triangles.front()[0] + 3 * triangles.size(), index,
                   [base](std::uint32_t v) { return base + v; });
}

}  // namespace relevo::lod
