#include "lod/lstr/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>

namespace relevo::lod {

double error_in(const PostField& field, const ChunkShape& shape) {
    double error = 0;
    for (const IndexTriangle& t : shape.triangles) {
        error = std::max(error,
                         field.error({&shape.posts[t[0]], &shape.posts[t[1]], &shape.posts[t[2]]}, INFINITY));
        for (std::size_t i = 0; i < 3; ++i)
            error =
                std::max(error, field.edge_error(shape.posts[t[i]], shape.posts[t[(i + 1) % 3]], INFINITY));
    }
    // What floats of positions relative to the field's middle may hide.
    return error + 4e-7 * field.extent_m();
}

Result<std::vector<double>> errors_in(const Terrain& terrain, const ChunkId& id,
                                      const std::vector<ChunkShape>& shapes) {
    constexpr int kPieceLevel = 5;
    const int level = std::min(id.level, kPieceLevel);
    const int below = id.level - level;
    const int side = 1 << below;
    const auto pieces = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<std::vector<double>> errors(pieces, std::vector<double>(shapes.size()));
    std::vector<std::optional<Error>> failures(pieces);
    tbb::parallel_for(0, side * side, [&](int i) {
        const ChunkId piece{level, (id.column << below) + i % side, (id.row << below) + i / side};
        if (!has_data(piece, terrain.frame())) return;
        const auto at = static_cast<std::size_t>(i);
        const auto field = PostField::read(terrain, piece.first(), piece.cells(), 1);
        if (!field) {
            failures[at] = field.error();
            return;
        }
        for (std::size_t k = 0; k < shapes.size(); ++k) errors[at][k] = error_in(*field, shapes[k]);
    });
    std::vector<double> most(shapes.size());
    for (std::size_t i = 0; i < pieces; ++i) {
        if (failures[i]) return *failures[i];
        for (std::size_t k = 0; k < shapes.size(); ++k) most[k] = std::max(most[k], errors[i][k]);
    }
    return most;
}

ChunkShape moved(const Terrain& terrain, const ChunkShape& shape, const CoarseSurface& coarse) {
    ChunkShape made = shape;
    for (PlacedPost& post : made.posts) {
        post.H = coarse.height(post);
        post.position = terrain.position(post.at.column, post.at.row, static_cast<double>(post.H), 1);
    }
    return made;
}

}  // namespace relevo::lod
