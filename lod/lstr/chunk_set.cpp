#include "lod/lstr/chunk_set.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::lod {

ChunkNode chunk_node(const Terrain& terrain, const ChunkMesh& mesh) {
    ChunkNode node{ChunkBox::of(terrain, mesh), mesh.error_m, mesh.moved_error_m, 0};
    for (const ChunkVertex& vertex : mesh.vertices)
        node.most_H_m = std::max({node.most_H_m, std::abs(static_cast<double>(vertex.H)),
                                  std::abs(static_cast<double>(vertex.coarse_H))});
    return node;
}

void add_to_level(const ChunkNode& node, ChunkSet::Level& level) {
    level.error_m = std::max(level.error_m, node.error_m);
    level.moved_error_m = std::max(level.moved_error_m, node.moved_error_m);
    level.diameter_m = std::max(level.diameter_m, node.box.diameter_m());
    level.most_H_m = std::max(level.most_H_m, node.most_H_m);
}

Result<MemoryChunks> MemoryChunks::build(const Terrain& terrain, const ChunkErrors& errors) {
    MemoryChunks made;
    made.levels_.resize(static_cast<std::size_t>(std::max(top_chunk_level(terrain.frame()), 0)) + 1);
    const auto keep = [&](const ChunkMesh& mesh) -> Result<void> {
        const ChunkNode node = chunk_node(terrain, mesh);
        add_to_level(node, made.levels_[static_cast<std::size_t>(mesh.id.level)]);
        made.entries_[mesh.id] = {node, std::make_shared<const ChunkMesh>(mesh)};
        return {};
    };
    if (auto done = ChunkBuilder(terrain, errors).build(keep); !done) return done.error();
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
