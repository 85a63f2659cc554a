#include "lod/lstr/chunk_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "geo/position.hpp"

namespace relevo::lod {

namespace {

glm::dvec3 middle_of(const Terrain& terrain, const ChunkId& id) {
    const int half = id.cells() / 2;
    return terrain.position(id.first().column + half, id.first().row + half, 0, 1);
}

}  // namespace

glm::dmat3 ChunkBox::axes_at(const Terrain& terrain, const ChunkId& id) {
    const geo::EnuFrame local(geo::to_geodetic({middle_of(terrain, id)}));
    return {local.east(), local.north(), local.up()};
}

ChunkBox ChunkBox::of(const Terrain& terrain, const ChunkMesh& mesh) {
    ChunkBox box;
    const glm::dvec3 middle = middle_of(terrain, mesh.id);
    box.axes = axes_at(terrain, mesh.id);
    glm::dvec3 lowest(std::numeric_limits<double>::infinity());
    glm::dvec3 highest = -lowest;
    for (const ChunkVertex& vertex : mesh.vertices) {
        for (const float H : {vertex.H, vertex.coarse_H}) {
            const glm::dvec3 at =
                (terrain.position(vertex.at.column, vertex.at.row, static_cast<double>(H), 1) - middle) *
                box.axes;
            lowest = glm::min(lowest, at);
            highest = glm::max(highest, at);
        }
    }
    box.half = 0.5 * (highest - lowest) + mesh.error_m;
    box.middle = middle + box.axes * (0.5 * (lowest + highest));
    return box;
}

ChunkBox ChunkBox::exaggerated(double exaggeration, double most_H_m) const {
    ChunkBox box = *this;
    box.half += std::abs(exaggeration - 1) * most_H_m;
    return box;
}

double ChunkBox::distance_m(const glm::dvec3& eye) const {
    const glm::dvec3 beyond = glm::abs((eye - middle) * axes) - half;
    return glm::length(glm::max(beyond, glm::dvec3(0)));
}

double ChunkBox::diameter_m() const {
    return 2 * glm::length(half);
}

bool ChunkBox::is_in(const View& view) const {
    const glm::dvec3 offset = middle - view.eye().m;
    for (const glm::dvec3& plane : view.side_planes()) {
        if (glm::dot(plane, offset) > glm::dot(glm::abs(plane * axes), half)) return false;
    }
    return true;
}

}  // namespace relevo::lod
