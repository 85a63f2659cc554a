#pragma once

#include <cstdint>
#include <functional>
#include <variant>

#include "lod/lstr/chunk_picture.hpp"
#include "lod/mesh.hpp"

namespace relevo::viewer {

/// What a frame's ground is drawn with: a mesh that was made for it, or nodes, most of which are in graphics
/// memory. Valid until what gave it is asked for the next.
using DrawnGround = std::variant<std::reference_wrapper<const lod::Mesh>, lod::ChunkPicture>;

inline std::uint64_t triangles(const DrawnGround& ground) {
    const auto* nodes = std::get_if<lod::ChunkPicture>(&ground);
    return nodes != nullptr ? nodes->triangles : std::get<0>(ground).get().triangles();
}
inline std::uint64_t vertices(const DrawnGround& ground) {
    const auto* nodes = std::get_if<lod::ChunkPicture>(&ground);
    return nodes != nullptr ? nodes->vertices : std::get<0>(ground).get().vertices.size();
}

}  // namespace relevo::viewer
