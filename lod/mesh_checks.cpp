#include "lod/mesh_checks.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

namespace {

std::uint64_t post_key(const GridPoint& p) {
    return static_cast<std::uint64_t>(p.row) << 16 | static_cast<std::uint64_t>(p.column);
}

std::uint64_t edge_key(const GridPoint& a, const GridPoint& b) {
    const auto [low, high] = std::minmax({post_key(a), post_key(b)});
    return low << 32 | high;
}

struct Edge {
    GridPoint from;
    GridPoint to;
    int uses = 0;
};

/// By edge_key.
std::unordered_map<std::uint64_t, Edge> edges_of(const Mesh& mesh) {
    std::unordered_map<std::uint64_t, Edge> edges;
    edges.reserve(mesh.indices.size());
    const auto post = [&](std::size_t i) {
        const MeshVertex& v = mesh.vertices[mesh.indices[i]];
        return GridPoint{v.column, v.row};
    };
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const GridPoint a = post(3 * t + k);
            const GridPoint b = post(3 * t + (k + 1) % 3);
            ++edges.try_emplace(edge_key(a, b), Edge{a, b}).first->second.uses;
        }
    }
    return edges;
}

}  // namespace

int count_t_vertices(const Mesh& mesh) {
    const auto edges = edges_of(mesh);
    int count = 0;
    for (const auto& [key, edge] : edges) {
        const bool has_middle =
            (edge.from.column + edge.to.column) % 2 == 0 && (edge.from.row + edge.to.row) % 2 == 0;
        if (edge.uses != 1 || !has_middle) continue;
        const GridPoint middle = midpoint(edge.from, edge.to);
        if (edges.contains(edge_key(edge.from, middle)) || edges.contains(edge_key(middle, edge.to))) ++count;
    }
    return count;
}

int count_open_edges(const Mesh& mesh, int columns, int rows) {
    const auto edges = edges_of(mesh);
    return static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](const auto& entry) {
        const auto& [from, to, uses] = entry.second;
        const bool on_border = (from.column <= 0 && to.column <= 0) || (from.row <= 0 && to.row <= 0) ||
                               (from.column >= columns - 1 && to.column >= columns - 1) ||
                               (from.row >= rows - 1 && to.row >= rows - 1);
        return uses == 1 && !on_border;
    }));
}

int count_torn_posts(const Mesh& mesh) {
    std::unordered_map<std::uint64_t, const MeshVertex*> first;
    int count = 0;
    for (const MeshVertex& v : mesh.vertices) {
        const auto [at, fresh] = first.try_emplace(post_key({v.column, v.row}), &v);
        const MeshVertex& other = *at->second;
        if (!fresh && (other.x != v.x || other.y != v.y || other.z != v.z)) ++count;
    }
    return count;
}

}  // namespace relevo::lod
