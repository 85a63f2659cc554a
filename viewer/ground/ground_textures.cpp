#include "viewer/ground/ground_textures.hpp"

#include <algorithm>

#include <epoxy/gl.h>

#include "lod/cache_sizes.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_memory.hpp"

namespace relevo::viewer {

namespace {

// As in shaders/ground.glsl.
constexpr GLuint kPostsUnit = 0;
constexpr GLuint kCellsUnit = 1;
constexpr GLuint kShoreUnit = 3;
constexpr GLuint kTableUnit = 4;

constexpr std::chrono::microseconds kUploadTime{2000};

GlTexture make_array(GLenum format, int side, int layers, GLint filter) {
    GlTexture texture(create_gl_texture(GL_TEXTURE_2D_ARRAY));
    const GlName name = texture.name();
    glTextureStorage3D(name, 1, format, side, side, layers);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

/// Slots that fit in the cache and in the driver's arrays, of which the terrain has a use.
int slot_count(const GroundData& data) {
    GLint layers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    const std::uint64_t all = GroundPages::count(data.pyramid->frame(), data.pyramid->top());
    const std::size_t cache =
        lod::texels_in(data.cache_bytes, free_graphics_memory()) / (data.drapes.empty() ? 1 : 2);
    const std::uint64_t in_cache = cache / page_bytes(data.facts);
    const auto most = static_cast<std::uint64_t>(std::min(layers, PageTable::kMostSlots));
    return static_cast<int>(std::max<std::uint64_t>(std::min({all, in_cache, most}), 1));
}

}  // namespace

Result<GroundTextures> GroundTextures::create(const lod::Terrain& terrain, const GroundData& data) {
    GroundTextures made;
    made.facts_ = data.facts;
    const int slots = slot_count(data);
    made.posts_ = make_array(GL_RGBA16_SNORM, kPagePosts, slots, GL_LINEAR);
    if (data.facts.has_sea) made.shore_ = make_array(GL_RG8, kPagePosts, slots, GL_LINEAR);
    if (data.facts.has_voids) made.cells_ = make_array(GL_R8UI, kPageCells, slots, GL_NEAREST);
    const std::size_t entries = PageTable(data.pyramid->top()).entries().size();
    made.table_entries_ = GlBuffer::create();
    glNamedBufferStorage(made.table_entries_.name(), static_cast<GLsizeiptr>(entries * sizeof(std::uint32_t)),
                         nullptr, GL_DYNAMIC_STORAGE_BIT);
    made.table_ = GlTexture(create_gl_texture(GL_TEXTURE_BUFFER));
    glTextureBuffer(made.table_.name(), GL_R32UI, made.table_entries_.name());
    if (auto done = gl_check("making room for the terrain's normals"); !done) return done.error();

    const auto fill = [posts = made.posts_.name(), shore = made.shore_.name(), cells = made.cells_.name()](
                          int slot, const PageTexels& texels) {
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage3D(posts, 0, 0, 0, slot, kPagePosts, kPagePosts, 1, GL_RGBA, GL_SHORT,
                            texels.posts.data());
        if (shore != 0)
            glTextureSubImage3D(shore, 0, 0, 0, slot, kPagePosts, kPagePosts, 1, GL_RG, GL_UNSIGNED_BYTE,
                                texels.shore.data());
        if (cells != 0)
            glTextureSubImage3D(cells, 0, 0, 0, slot, kPageCells, kPageCells, 1, GL_RED_INTEGER,
                                GL_UNSIGNED_BYTE, texels.cells.data());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    };
    auto pages = GroundPages::create(data, terrain.positions(), terrain.undulations(), slots, fill);
    if (!pages) return pages.error();
    made.pages_ = *std::move(pages);
    made.upload_table();
    if (auto done = gl_check("loading the terrain's normals"); !done) return done.error();
    return made;
}

void GroundTextures::update(const Sight& sight, double exaggeration) {
    pages_->want(sight, exaggeration);
    pages_->take_ready(kUploadTime);
    upload_table();
}

Result<void> GroundTextures::complete(const Sight& sight, double exaggeration) {
    pages_->want(sight, exaggeration);
    auto done = pages_->complete();
    upload_table();
    return done;
}

void GroundTextures::upload_table() {
    if (!pages_->table_changed()) return;
    const std::vector<std::uint32_t>& entries = pages_->table().entries();
    glNamedBufferSubData(table_entries_.name(), 0,
                         static_cast<GLsizeiptr>(entries.size() * sizeof(std::uint32_t)), entries.data());
}

void GroundTextures::bind() const {
    glBindTextureUnit(kPostsUnit, posts_.name());
    glBindTextureUnit(kShoreUnit, shore_.name());
    glBindTextureUnit(kCellsUnit, cells_.name());
    glBindTextureUnit(kTableUnit, table_.name());
}

}  // namespace relevo::viewer
