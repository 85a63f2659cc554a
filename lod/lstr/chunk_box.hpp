#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lod/lstr/chunk_mesh.hpp"
#include "lod/terrain.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// A box along east, north and up at a node's middle that holds what the node and all nodes below it draw.
struct ChunkBox {
    glm::dmat3 axes{1};    ///< columns: east, north, up
    glm::dvec3 middle{0};  ///< ECEF
    glm::dvec3 half{0};    ///< sizes along the axes, metres

    /// Of a mesh that no valid post is farther from than its error.
    static ChunkBox of(const Terrain& terrain, const ChunkMesh& mesh);

    /// East, north and up at a node's middle.
    static glm::dmat3 axes_at(const Terrain& terrain, const ChunkId& id);

    /// As heights exaggerated make it.
    ChunkBox exaggerated(double exaggeration, double most_H_m) const;

    /// Of the box's nearest point, metres; 0 inside.
    double distance_m(const glm::dvec3& eye) const;
    double diameter_m() const;
    bool is_in(const View& view) const;
};

}  // namespace relevo::lod
