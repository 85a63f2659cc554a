#pragma once

#include <cstdint>
#include <vector>

namespace relevo::lod {

/// A vertex as it goes to the GPU.
struct MeshVertex {
    float x, y, z;         ///< drawn position relative to the eye, ECEF axes, metres
    std::uint16_t column;  ///< place in the padded grid
    std::uint16_t row;
};

/// A drawn mesh: indexed triangles, counter-clockwise seen from above. The last index of a triangle is its
/// newest vertex (the right angle), so that flat attributes can show its level.
struct Mesh {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint32_t> indices;

    std::size_t triangles() const { return indices.size() / 3; }
    void clear() {
        vertices.clear();
        indices.clear();
    }
};

}  // namespace relevo::lod
