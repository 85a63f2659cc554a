#include "viewer/ground/node_buffers.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "lod/lstr/finer_sides.hpp"

namespace relevo::viewer {

namespace {

using Vertex = lod::PlacedChunk::Vertex;

// As in shaders/terrain.vert: what a vertex moves with. A side is 1 + its number.
constexpr std::uint8_t kInside = 0;
constexpr std::uint8_t kAtCoarser = 1 + lod::kSides;

constexpr GLint kMovedOnSide = 0;
constexpr GLint kMoved = 1;
constexpr GLint kBase = 2;
constexpr GLint kBaseFromEye = 3;
constexpr GLint kEye = 4;

std::vector<std::uint8_t> parts_of(const lod::PlacedChunk& chunk, std::size_t finer) {
    std::vector<std::uint8_t> parts(chunk.vertices.size() + finer, kInside);
    // A corner either stays where it is, or both of its sides move as the inside does.
    for (std::size_t side = 0; side < lod::kSides; ++side) {
        for (const lod::SideVertex& on : chunk.sides[side])
            parts[on.vertex] = static_cast<std::uint8_t>(1 + side);
    }
    std::fill(parts.end() - static_cast<std::ptrdiff_t>(finer), parts.end(), kAtCoarser);
    return parts;
}

}  // namespace

NodeBuffers::NodeBuffers() : vertex_array_(GlVertexArray::create()) {
    const GlName array = vertex_array_.name();
    const auto attribute = [&](GLuint index, GLuint binding) {
        glEnableVertexArrayAttrib(array, index);
        glVertexArrayAttribBinding(array, index, binding);
    };
    attribute(0, 0);
    glVertexArrayAttribIFormat(array, 0, 3, GL_INT, offsetof(Vertex, at));
    attribute(1, 0);
    glVertexArrayAttribIFormat(array, 1, 2, GL_UNSIGNED_SHORT, offsetof(Vertex, column));
    attribute(2, 0);
    glVertexArrayAttribFormat(array, 2, 1, GL_FLOAT, GL_FALSE, offsetof(Vertex, rise_m));
    attribute(3, 1);
    glVertexArrayAttribIFormat(array, 3, 1, GL_UNSIGNED_BYTE, 0);
}

NodeBuffers::Node NodeBuffers::send(const lod::SelectedChunk& chunk) {
    const lod::FinerSides finer = lod::finer_sides(chunk);
    const std::vector<Vertex>& own = chunk.chunk->vertices;
    const std::size_t vertices = own.size() + finer.vertices.size();
    const std::vector<std::uint8_t> parts = parts_of(*chunk.chunk, finer.vertices.size());
    std::vector<std::uint32_t> indices(3 * (chunk.chunk->triangles->size() + finer.vertices.size()));
    lod::write_triangles(chunk, finer.seams, 0, indices.data());

    Node made;
    made.index_count = static_cast<int>(indices.size());
    made.parts_at = static_cast<std::intptr_t>(vertices * sizeof(Vertex));
    made.indices_at = (made.parts_at + static_cast<std::intptr_t>(vertices) + 3) / 4 * 4;
    made.bytes = static_cast<std::uint64_t>(made.indices_at) + indices.size() * sizeof(indices[0]);
    std::vector<std::byte> bytes(made.bytes);
    const auto put = [&](const auto& values, std::intptr_t at) {
        const auto from = std::as_bytes(std::span(values));
        std::copy(from.begin(), from.end(), bytes.begin() + at);
    };
    put(own, 0);
    put(finer.vertices, static_cast<std::intptr_t>(own.size() * sizeof(Vertex)));
    put(parts, made.parts_at);
    put(indices, made.indices_at);
    made.buffer = GlBuffer::create();
    glNamedBufferStorage(made.buffer.name(), static_cast<GLsizeiptr>(bytes.size()), bytes.data(), 0);
    return made;
}

void NodeBuffers::upload(const lod::ChunkPicture& picture) {
    if (edition_ != picture.edition) {
        nodes_.clear();
        figures_ = {};
        edition_ = picture.edition;
    }
    frame_ = picture.frame;
    ++pictures_;
    figures_.sent_bytes = 0;
    drawn_.clear();
    std::uint64_t drawn_bytes = 0;
    for (const lod::SelectedChunk& chunk : *picture.nodes) {
        Key key{chunk.id, {}};
        for (std::size_t side = 0; side < lod::kSides; ++side)
            key.beside_finer[side] = chunk.finer[side] != nullptr;
        auto known = nodes_.find(key);
        if (known == nodes_.end()) {
            known = nodes_.emplace(key, send(chunk)).first;
            figures_.bytes += known->second.bytes;
            figures_.sent_bytes += known->second.bytes;
        }
        Node& node = known->second;
        node.last_drawn = pictures_;
        drawn_bytes += node.bytes;
        Drawn drawn{&node, static_cast<float>(chunk.moved), {}};
        std::transform(chunk.moved_on_side.begin(), chunk.moved_on_side.end(), drawn.moved_on_side.begin(),
                       [](double moved) { return static_cast<float>(moved); });
        drawn_.push_back(drawn);
    }
    make_room(drawn_bytes);
    figures_.nodes = nodes_.size();
}

void NodeBuffers::make_room(std::uint64_t drawn_bytes) {
    if (figures_.bytes <= 2 * drawn_bytes) return;
    std::vector<std::pair<std::uint64_t, Key>> others;
    for (const auto& [key, node] : nodes_) {
        if (node.last_drawn != pictures_) others.emplace_back(node.last_drawn, key);
    }
    std::sort(others.begin(), others.end());
    for (const auto& [last_drawn, key] : others) {
        if (figures_.bytes <= 2 * drawn_bytes) return;
        const auto gone = nodes_.find(key);
        figures_.bytes -= gone->second.bytes;
        nodes_.erase(gone);
    }
}

int NodeBuffers::draw(const lod::View& view) const {
    // Whole numbers are subtracted without error: a place that two nodes have is the same in both. An eye far
    // from the terrain is beyond what the numbers hold.
    const double far = glm::exp2(30.0) - 1;
    const glm::dvec3 eye = (view.eye().m - frame_.origin) / frame_.unit_m;
    const glm::ivec3 base(glm::round(glm::clamp(eye, -far, far)));
    const glm::vec3 base_from_eye(frame_.place(base) - view.eye().m);
    const glm::vec3 eye_at(view.eye().m);
    glUniform3i(kBase, base.x, base.y, base.z);
    glUniform4f(kBaseFromEye, base_from_eye.x, base_from_eye.y, base_from_eye.z,
                static_cast<float>(frame_.unit_m));
    glUniform3f(kEye, eye_at.x, eye_at.y, eye_at.z);
    const GlName array = vertex_array_.name();
    glBindVertexArray(array);
    for (const Drawn& drawn : drawn_) {
        const Node& node = *drawn.node;
        glVertexArrayVertexBuffer(array, 0, node.buffer.name(), 0, sizeof(Vertex));
        glVertexArrayVertexBuffer(array, 1, node.buffer.name(), node.parts_at, 1);
        glVertexArrayElementBuffer(array, node.buffer.name());
        glUniform4fv(kMovedOnSide, 1, drawn.moved_on_side.data());
        glUniform1f(kMoved, drawn.moved);
        glDrawElements(GL_TRIANGLES, node.index_count, GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(node.indices_at));
    }
    return static_cast<int>(drawn_.size());
}

}  // namespace relevo::viewer
