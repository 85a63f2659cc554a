#include "lod/pyramid/pyramid.hpp"

#include <utility>

namespace relevo::lod {

Result<BlockHeights> Pyramid::read_heights(const PyramidBlock& block) const {
    auto vertices = read_vertices(block, ErrorMetric::bounded);
    if (!vertices) return vertices.error();
    auto ground = read_ground(block);
    if (!ground) return ground.error();
    return BlockHeights{std::move(vertices->heights), std::move(ground->heights)};
}

}  // namespace relevo::lod
