#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lod/soar/diamond.hpp"

namespace relevo::lod {

/// A vertex of the mesh being refined.
struct RefinedVertex {
    glm::dvec3 exact;  ///< where the data has it, relative to the eye
    glm::dvec3 drawn;  ///< where the morph draws it
    GridPoint post;
    std::uint32_t index = 0;  ///< in the mesh
    double radius = 0;        ///< of its sphere, metres
};

/// Finds the vertices that were made a short while ago: every inner vertex is reached from the triangles on
/// both sides of the edge that it splits. Direct-mapped, so that a collision only makes a vertex twice, at
/// the very same place; entries of earlier frames are told by their frame number, so that nothing needs
/// clearing.
class VertexCache {
  public:
    VertexCache() : entries_(kEntries) {}

    void start_frame() { ++frame_; }

    const RefinedVertex* find(const GridPoint& post) const {
        const Entry& entry = entries_[slot(post)];
        return entry.frame == frame_ && entry.vertex.post == post ? &entry.vertex : nullptr;
    }

    void keep(const RefinedVertex& vertex) { entries_[slot(vertex.post)] = {vertex, frame_}; }

  private:
    struct Entry {
        RefinedVertex vertex;
        std::uint32_t frame = 0;
    };
    static constexpr std::size_t kEntries =
        1 << 14;  // 1 MiB: larger ones save no vertices that matter and cost cache

    static std::size_t slot(const GridPoint& post) {
        const auto mixed = static_cast<std::uint32_t>(post.column) * 0x9e3779b1u ^
                           static_cast<std::uint32_t>(post.row) * 0x85ebca77u;
        return (mixed >> 16) % kEntries;
    }

    std::vector<Entry> entries_;
    std::uint32_t frame_ = 0;
};

}  // namespace relevo::lod
