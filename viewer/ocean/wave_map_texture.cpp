#include "viewer/ocean/wave_map_texture.hpp"

#include <array>
#include <cmath>

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace relevo::viewer {

namespace {

// As in shaders/wave_map.glsl.
constexpr GLuint kBinding = 3;
constexpr GLuint kUnit = 7;
struct Block {
    std::array<glm::vec4, 2> origins, turns;
};

}  // namespace

WaveMapTexture::WaveMapTexture(const lod::WaveMap& map)
    : levels_(create_gl_texture(GL_TEXTURE_2D)), block_(GlBuffer::create()) {
    const auto& levels = map.levels();
    const int side = levels.front().side;
    glTextureStorage2D(levels_.name(), static_cast<GLsizei>(levels.size()), GL_R32F, side, side);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        glTextureSubImage2D(levels_.name(), static_cast<GLint>(i), 0, 0, levels[i].side, levels[i].side,
                            GL_RED, GL_FLOAT, levels[i].coefficients.data());
    }
    glTextureParameteri(levels_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTextureParameteri(levels_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glNamedBufferStorage(block_.name(), sizeof(Block), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void WaveMapTexture::update(const lod::WaveMap& map, const glm::dvec2& nadir, double time_s) {
    Block block{};
    for (std::size_t i = 0; i < block.origins.size(); ++i) {
        const lod::WaveMap::Copy& copy = map.copies()[i];
        const double posts_a_metre = map.levels().front().side / copy.tile_m;
        block.origins[i] = glm::dvec4(glm::fract(copy.in_tile(nadir, time_s)),
                                      lod::kPostsPerSpacing * posts_a_metre, copy.length_m);
        block.turns[i] = glm::dvec4(copy.turn / copy.tile_m, 0, 0);
    }
    glNamedBufferSubData(block_.name(), 0, sizeof(block), &block);
}

void WaveMapTexture::bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, kBinding, block_.name());
    glBindTextureUnit(kUnit, levels_.name());
}

}  // namespace relevo::viewer
