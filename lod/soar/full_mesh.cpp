#include "lod/soar/full_mesh.hpp"

#include <cmath>

#include "lod/soar/cell.hpp"

namespace relevo::lod {

Mesh full_mesh(const Terrain& terrain, const View& view, double exaggeration) {
    const geo::GridFrame& frame = terrain.frame();
    const auto columns = static_cast<std::uint32_t>(frame.columns);
    Mesh mesh;
    mesh.vertices.reserve(static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows));
    TruePosts::Reader posts(terrain.posts());
    for (int row = 0; row < frame.rows; ++row) {
        for (int column = 0; column < frame.columns; ++column) {
            const float H = posts.H(column, row);  // a void's vertex is in no triangle
            const glm::vec3 offset(
                terrain.position(column, row, std::isnan(H) ? 0 : static_cast<double>(H), exaggeration) -
                view.eye().m);
            mesh.vertices.push_back({offset.x, offset.y, offset.z, static_cast<std::uint16_t>(column),
                                     static_cast<std::uint16_t>(row)});
        }
    }
    const auto index = [columns](const GridPoint& p) {
        return static_cast<std::uint32_t>(p.row) * columns + static_cast<std::uint32_t>(p.column);
    };
    for (int row = 0; row + 1 < frame.rows; ++row) {
        for (int column = 0; column + 1 < frame.columns; ++column) {
            if (!posts.is_valid_cell(column, row)) continue;
            for (const CellTriangle& triangle : cell_triangles({column, row})) {
                for (const GridPoint& corner : triangle) mesh.indices.push_back(index(corner));
            }
        }
    }
    return mesh;
}

}  // namespace relevo::lod
