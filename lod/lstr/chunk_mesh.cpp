#include "lod/lstr/chunk_mesh.hpp"

#include "lod/lstr/triangle_order.hpp"

namespace relevo::lod {

ChunkMesh finished(const ChunkShape& shape, const CoarseSurface* coarse) {
    ChunkMesh mesh{
        shape.id, shape.error_m, shape.error_m, {}, strip_order(shape.triangles, shape.posts.size()), {}};
    mesh.vertices.reserve(shape.posts.size());
    for (const PlacedPost& post : shape.posts)
        mesh.vertices.push_back({post.at, post.H, coarse ? coarse->height(post) : post.H});
    for (int side = 0; side < kSides; ++side) {
        for (const std::uint32_t v : shape.side(static_cast<Side>(side))) {
            mesh.sides[static_cast<std::size_t>(side)].push_back(
                {v, coarse == nullptr || coarse->has(shape.posts[v].at)});
        }
    }
    return mesh;
}

ChunkShape shape_of(const Terrain& terrain, const ChunkMesh& mesh) {
    ChunkShape shape{mesh.id, {}, mesh.triangles, mesh.error_m};
    shape.posts.reserve(mesh.vertices.size());
    for (const ChunkVertex& v : mesh.vertices)
        shape.posts.push_back(
            {v.at, v.H, terrain.position(v.at.column, v.at.row, static_cast<double>(v.H), 1)});
    return shape;
}

}  // namespace relevo::lod
