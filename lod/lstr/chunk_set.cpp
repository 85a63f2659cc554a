#include "lod/lstr/chunk_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relevo::lod {

ChunkNode chunk_node(const Terrain& terrain, const ChunkMesh& mesh) {
    ChunkNode node{ChunkBox::of(terrain, mesh), mesh.error_m, mesh.moved_error_m, 0,
                   static_cast<std::uint32_t>(mesh.vertices.size())};
    for (const ChunkVertex& vertex : mesh.vertices)
        node.most_H_m = std::max({node.most_H_m, std::abs(static_cast<double>(vertex.H)),
                                  std::abs(static_cast<double>(vertex.coarse_H))});
    return node;
}

Result<MemoryChunks> MemoryChunks::build(const Terrain& terrain, const ChunkErrors& errors) {
    MemoryChunks made;
    const auto keep = [&](const ChunkMesh& mesh) -> ChunkBuilder::Writing {
        Entry entry{chunk_node(terrain, mesh), std::make_shared<const ChunkMesh>(mesh)};
        return [&made, entry = std::move(entry)]() -> Result<void> {
            made.entries_[entry.mesh->id] = entry;
            return {};
        };
    };
    if (auto done = ChunkBuilder(terrain, {errors}).build(keep); !done) return done.error();
    return made;
}

const ChunkNode* MemoryChunks::node(const ChunkId& id) const {
    const auto found = entries_.find(id);
    return found == entries_.end() ? nullptr : &found->second.node;
}

Result<std::shared_ptr<const ChunkMesh>> MemoryChunks::mesh(const ChunkId& id) const {
    return entries_.at(id).mesh;
}

}  // namespace relevo::lod
