#include "viewer/ground/ground_cover.hpp"

#include <algorithm>
#include <vector>

#include <epoxy/gl.h>
#include <tbb/parallel_for.h>

#include "viewer/ground/cover_block.hpp"
#include "viewer/ground/ground_materials.hpp"

namespace relevo::viewer {

namespace {

// As in shaders/cover.glsl and cover_block.glsl.
constexpr GLuint kMaterialsUnit = 8;
constexpr GLuint kMapUnit = 9;
constexpr GLuint kCoverBinding = 4;

GlTexture texture_of(const GroundMap& map) {
    GlTexture made(create_gl_texture(GL_TEXTURE_2D));
    const GlName name = made.name();
    int levels = 1;
    while (std::max(map.columns, map.rows) >> levels > 0) ++levels;
    glTextureStorage2D(name, levels, GL_RGBA8, map.columns, map.rows);
    glTextureSubImage2D(name, 0, 0, 0, map.columns, map.rows, GL_RGBA, GL_UNSIGNED_BYTE, map.shares.data());
    glGenerateTextureMipmap(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return made;
}

}  // namespace

GroundCover::GroundCover(const GroundMap* map) {
    if (map != nullptr) map_ = texture_of(*map);
    std::array<std::vector<MaterialTexel>, kMaterials> tiles;
    tbb::parallel_for(0, kMaterials, [&](int i) {
        tiles[static_cast<std::size_t>(i)] = material_tile(static_cast<Material>(i));
    });
    materials_ = GlTexture(create_gl_texture(GL_TEXTURE_2D_ARRAY));
    const GlName name = materials_.name();
    int levels = 1;
    while (kMaterialSide >> levels > 0) ++levels;
    glTextureStorage3D(name, levels, GL_RGBA8, kMaterialSide, kMaterialSide, kMaterials);
    for (int i = 0; i < kMaterials; ++i)
        glTextureSubImage3D(name, 0, 0, 0, i, kMaterialSide, kMaterialSide, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            tiles[static_cast<std::size_t>(i)].data());
    glGenerateTextureMipmap(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_REPEAT);
    block_ = GlBuffer::create();
    glNamedBufferStorage(block_.name(), sizeof(CoverBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void GroundCover::update(const geo::GridFrame& grid, geo::LatLon eye) {
    const CoverBlock block = cover_block(grid, eye);
    glNamedBufferSubData(block_.name(), 0, sizeof(block), &block);
}

void GroundCover::bind() const {
    glBindTextureUnit(kMaterialsUnit, materials_.name());
    if (map_) glBindTextureUnit(kMapUnit, map_.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kCoverBinding, block_.name());
}

}  // namespace relevo::viewer
