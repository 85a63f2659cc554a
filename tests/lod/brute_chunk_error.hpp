#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "lod/lstr/chunk_mesh.hpp"
#include "lod/static_mesh/grid_triangle.hpp"
#include "lod/terrain.hpp"

namespace relevo::test {

/// How far a node's mesh is from its valid posts at the same grid coordinates, by looking at every post of
/// every triangle; -1 where it has none.
inline double brute_error_m(const lod::Terrain& terrain, const lod::ChunkMesh& mesh) {
    double worst_m = -1;
    lod::TruePosts::Reader posts(terrain.posts());
    for (const lod::IndexTriangle& t : mesh.triangles) {
        const lod::ChunkVertex& a = mesh.vertices[t[0]];
        const lod::ChunkVertex& b = mesh.vertices[t[1]];
        const lod::ChunkVertex& c = mesh.vertices[t[2]];
        const auto place = [&](const lod::ChunkVertex& v) {
            return terrain.position(v.at.column, v.at.row, static_cast<double>(v.H), 1);
        };
        const glm::dvec3 at_a = place(a), at_b = place(b), at_c = place(c);
        const auto [left, right] = std::minmax({a.at.column, b.at.column, c.at.column});
        const auto [top, bottom] = std::minmax({a.at.row, b.at.row, c.at.row});
        const auto area = static_cast<double>(lod::turn(a.at, b.at, c.at));
        for (int y = top; y <= std::min(bottom, terrain.frame().rows - 1); ++y) {
            for (int x = left; x <= std::min(right, terrain.frame().columns - 1); ++x) {
                const auto to_a = static_cast<double>(lod::turn(b.at, c.at, {x, y})) / area;
                const auto to_b = static_cast<double>(lod::turn(c.at, a.at, {x, y})) / area;
                if (to_a < 0 || to_b < 0 || to_a + to_b > 1) continue;
                const auto H = static_cast<double>(posts.H(x, y));
                if (std::isnan(H)) continue;
                const glm::dvec3 drawn = to_a * at_a + to_b * at_b + (1 - to_a - to_b) * at_c;
                worst_m = std::max(worst_m, glm::distance(drawn, terrain.position(x, y, H, 1)));
            }
        }
    }
    return worst_m;
}

}  // namespace relevo::test
