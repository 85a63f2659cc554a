#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "lod/mesh.hpp"
#include "lod/soar/diamond.hpp"

namespace relevo::test {

/// Edges of a mesh that are split on one side only: T-vertices, where a crack would open. Independent of how the mesh
/// was made: an edge used by one triangle alone, whose halves are edges too.
inline int count_t_vertices(const lod::Mesh& mesh) {
    using lod::GridPoint;
    const auto point = [&](std::uint32_t index) {
        return GridPoint{mesh.vertices[index].column, mesh.vertices[index].row};
    };
    const auto key = [](GridPoint a, GridPoint b) {
        const auto pack = [](const GridPoint& p) {
            return static_cast<std::uint64_t>(p.row) << 16 | static_cast<std::uint64_t>(p.column);
        };
        const auto [low, high] = std::minmax(pack(a), pack(b));
        return low << 32 | high;
    };
    std::unordered_map<std::uint64_t, std::pair<GridPoint, GridPoint>> once;
    std::unordered_map<std::uint64_t, int> uses;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const GridPoint a = point(mesh.indices[3 * t + k]);
            const GridPoint b = point(mesh.indices[3 * t + (k + 1) % 3]);
            ++uses[key(a, b)];
            once[key(a, b)] = {a, b};
        }
    }
    int count = 0;
    for (const auto& [edge, ends] : once) {
        const auto& [a, b] = ends;
        const GridPoint middle = lod::midpoint(a, b);
        if (middle == a || middle == b) continue;
        if ((a.column + b.column) % 2 != 0 || (a.row + b.row) % 2 != 0) continue;
        if (uses[edge] == 1 && (uses.contains(key(a, middle)) || uses.contains(key(middle, b)))) ++count;
    }
    return count;
}

/// Vertices of one post that are drawn at more than one place (a crack by rounding).
inline int count_torn_posts(const lod::Mesh& mesh) {
    std::unordered_map<std::uint32_t, const lod::MeshVertex*> first;
    int count = 0;
    for (const lod::MeshVertex& v : mesh.vertices) {
        const auto [at, fresh] = first.try_emplace(static_cast<std::uint32_t>(v.row) << 16 | v.column, &v);
        if (!fresh && (at->second->x != v.x || at->second->y != v.y || at->second->z != v.z)) ++count;
    }
    return count;
}

}  // namespace relevo::test
