#include "viewer/ocean/mesh_buffers.hpp"

#include <cstdint>

#include <epoxy/gl.h>

namespace relevo::viewer {

MeshBuffers::MeshBuffers(const lod::OceanMesh& mesh)
    : vertices_(GlBuffer::create()),
      indices_(GlBuffer::create()),
      copies_(GlBuffer::create()),
      array_(GlVertexArray::create()) {
    std::vector<glm::i16vec2> vertices;
    std::vector<std::uint16_t> indices;
    for (const lod::OceanPatch& patch : mesh.patches()) {
        patches_.push_back({vertices.size(), patch.vertices.size(), indices.size(), patch.indices.size()});
        vertices.insert(vertices.end(), patch.vertices.begin(), patch.vertices.end());
        indices.insert(indices.end(), patch.indices.begin(), patch.indices.end());
    }
    const auto store = [](const GlBuffer& buffer, const auto& data) {
        glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(data.size() * sizeof(data[0])),
                             data.data(), 0);
    };
    store(vertices_, vertices);
    store(indices_, indices);
    const GlName array = array_.name();
    glVertexArrayElementBuffer(array, indices_.name());
    glVertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(glm::i16vec2));
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribIFormat(array, 0, 2, GL_SHORT, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glVertexArrayVertexBuffer(array, 1, copies_.name(), 0, sizeof(glm::vec4));
    glVertexArrayBindingDivisor(array, 1, 1);
    glEnableVertexArrayAttrib(array, 1);
    glVertexArrayAttribFormat(array, 1, 4, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 1, 1);
}

void MeshBuffers::upload(const lod::OceanPicture& picture) {
    runs_ = {};
    std::vector<glm::vec4> copies;
    for (std::size_t patch = 0; patch < picture.copies.size(); ++patch) {
        const auto add = [&](const std::vector<glm::vec4>& some, std::vector<Run>& runs) {
            if (some.empty()) return;
            runs.push_back({patch, copies.size(), some.size()});
            copies.insert(copies.end(), some.begin(), some.end());
        };
        add(picture.copies[patch].open, runs_.open);
        add(picture.copies[patch].shore, runs_.shore);
    }
    glNamedBufferData(copies_.name(), static_cast<GLsizeiptr>(copies.size() * sizeof(glm::vec4)),
                      copies.data(), GL_STREAM_DRAW);
}

void MeshBuffers::bind() const {
    glBindVertexArray(array_.name());
}

void MeshBuffers::draw(const Run& run) const {
    const Patch& patch = patches_[run.patch];
    const auto* indices = reinterpret_cast<const void*>(patch.first_index * sizeof(std::uint16_t));
    glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(patch.indices),
                                                  GL_UNSIGNED_SHORT, indices, static_cast<GLsizei>(run.count),
                                                  static_cast<GLint>(patch.first_vertex),
                                                  static_cast<GLuint>(run.first));
}

}  // namespace relevo::viewer
