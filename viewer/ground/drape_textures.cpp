#include "viewer/ground/drape_textures.hpp"

#include <algorithm>

#include <epoxy/gl.h>

#include "lod/cache_sizes.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_memory.hpp"

namespace relevo::viewer {

namespace {

// As in shaders/drape.glsl: two units a drape.
constexpr GLuint kFirstUnit = 10;
constexpr std::chrono::microseconds kUploadTime{2000};
constexpr std::size_t kPageBytes = std::size_t{4} * kPagePosts * kPagePosts;

}  // namespace

geo::GridFrame finer_frame(geo::GridFrame frame, int finer) {
    const int times = 1 << finer;
    frame.step_x /= times;
    frame.step_y /= times;
    frame.columns = (frame.columns - 1) * times + 1;
    frame.rows = (frame.rows - 1) * times + 1;
    return frame;
}

Result<DrapeTextures> DrapeTextures::create(const lod::Terrain& terrain, const GroundData& data,
                                            std::shared_ptr<const Drape> drape, std::size_t cache_bytes) {
    using Cache = PageCache<DrapeTexels>;
    DrapeTextures made;
    made.drape_ = std::move(drape);
    const geo::GridFrame frame = finer_frame(terrain.frame(), made.finer());
    const int top = Cache::top_of(frame);

    GLint layers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    const std::uint64_t in_cache = lod::texels_in(cache_bytes, free_graphics_memory()) / kPageBytes;
    const auto most = static_cast<std::uint64_t>(std::min(layers, PageTable::kMostSlots));
    const auto slots =
        static_cast<int>(std::max<std::uint64_t>(std::min({Cache::count(frame, top), in_cache, most}), 1));

    made.texels_ = GlTexture(create_gl_texture(GL_TEXTURE_2D_ARRAY));
    const GlName name = made.texels_.name();
    glTextureStorage3D(name, 1, GL_RGBA8, kPagePosts, kPagePosts, slots);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    const std::size_t entries = PageTable(top).entries().size();
    made.table_entries_ = GlBuffer::create();
    glNamedBufferStorage(made.table_entries_.name(), static_cast<GLsizeiptr>(entries * sizeof(std::uint32_t)),
                         nullptr, GL_DYNAMIC_STORAGE_BIT);
    made.table_ = GlTexture(create_gl_texture(GL_TEXTURE_BUFFER));
    glTextureBuffer(made.table_.name(), GL_R32UI, made.table_entries_.name());
    made.bytes_ = static_cast<std::size_t>(slots) * kPageBytes + entries * sizeof(std::uint32_t);
    if (auto done = gl_check("making room for what is draped over the terrain"); !done) return done.error();

    const int terrain_top = terrain.pyramid()->top();
    auto coarse = terrain.pyramid()->read_ground({terrain_top, 0, 0});
    if (!coarse) return coarse.error();
    auto pages = Cache::create(
        {.frame = frame,
         .bounds = PageBounds(terrain.frame(), terrain.positions(), terrain.undulations(), data.facts,
                              made.finer(), std::move(coarse->heights), terrain_top),
         .load = [of = made.drape_](const Page& page) { return of->read(page); },
         .fill =
             [name](int slot, const DrapeTexels& texels) {
                 glTextureSubImage3D(name, 0, 0, 0, slot, kPagePosts, kPagePosts, 1, GL_RGBA,
                                     GL_UNSIGNED_BYTE, texels.data());
             },
         .report = data.report},
        slots);
    if (!pages) return pages.error();
    made.pages_ = *std::move(pages);
    made.upload_table();
    if (auto done = gl_check("loading what is draped over the terrain"); !done) return done.error();
    return made;
}

void DrapeTextures::update(const Sight& sight, double exaggeration) {
    pages_->want(sight, exaggeration);
    pages_->take_ready(kUploadTime);
    upload_table();
}

Result<void> DrapeTextures::complete(const Sight& sight, double exaggeration) {
    pages_->want(sight, exaggeration);
    auto done = pages_->complete();
    upload_table();
    return done;
}

void DrapeTextures::upload_table() {
    if (!pages_->table_changed()) return;
    const std::vector<std::uint32_t>& entries = pages_->table().entries();
    glNamedBufferSubData(table_entries_.name(), 0,
                         static_cast<GLsizeiptr>(entries.size() * sizeof(std::uint32_t)), entries.data());
}

void DrapeTextures::bind(int number) const {
    const GLuint unit = kFirstUnit + 2 * static_cast<GLuint>(number);
    glBindTextureUnit(unit, texels_.name());
    glBindTextureUnit(unit + 1, table_.name());
}

}  // namespace relevo::viewer
