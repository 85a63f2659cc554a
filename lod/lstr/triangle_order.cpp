#include "lod/lstr/triangle_order.hpp"

#include <algorithm>
#include <utility>

#include <meshoptimizer.h>

namespace relevo::lod {

namespace {

using Optimize = void(unsigned* ordered, const unsigned* indices, std::size_t count, std::size_t vertices);

std::vector<IndexTriangle> ordered_by(Optimize* optimize, std::vector<IndexTriangle> triangles,
                                      std::size_t vertices) {
    if (triangles.empty()) return triangles;
    for (IndexTriangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles.begin(), triangles.end());
    std::vector<IndexTriangle> ordered(triangles.size());
    optimize(ordered.front().data(), triangles.front().data(), 3 * triangles.size(), vertices);
    return ordered;
}

}  // namespace

std::vector<IndexTriangle> cache_order(std::vector<IndexTriangle> triangles, std::size_t vertices) {
    return ordered_by(meshopt_optimizeVertexCache, std::move(triangles), vertices);
}

std::vector<IndexTriangle> strip_order(std::vector<IndexTriangle> triangles, std::size_t vertices) {
    return ordered_by(meshopt_optimizeVertexCacheStrip, std::move(triangles), vertices);
}

}  // namespace relevo::lod
