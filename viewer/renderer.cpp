#include "viewer/renderer.hpp"

#include <cassert>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <variant>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "viewer/frame_block.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_program.hpp"

namespace relevo::viewer {

namespace {

constexpr GLuint kFrameBinding = 0;
constexpr GLuint kRampUnit = 2;  // the others are GroundTextures'

/// Fills a buffer that is made anew every frame. Fresh storage of the same size lets the driver keep the old
/// one for a frame that is still being drawn.
void stream(const GlBuffer& buffer, std::size_t& capacity, const void* data, std::size_t bytes) {
    if (bytes > capacity) capacity = bytes + bytes / 2;
    if (capacity == 0) return;
    glNamedBufferData(buffer.name(), static_cast<GLsizeiptr>(capacity), nullptr, GL_STREAM_DRAW);
    glNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(bytes), data);
}

/// What the ground's pages are asked for. The plain layer is lit at its vertices, which are pixels apart.
Sight sight_of(const lod::View& view, const PicturePart& part, Layer layer) {
    constexpr double kVertexPixels = 4;
    return {view, part, layer == Layer::plain ? kVertexPixels : 1};
}

bool has_ramp(Layer layer) {
    return layer == Layer::hypsometric || layer == Layer::slope || layer == Layer::aspect;
}

bool is_shaded(Layer layer) {
    return layer == Layer::hypsometric || layer == Layer::hillshade || layer == Layer::lod;
}

const char* shading_define(Shading shading) {
    switch (shading) {
        case Shading::multidirectional:
            return "#define FOUR_LIGHTS\n";
        case Shading::oblique:
            return "#define FOUR_LIGHTS\n#define OBLIQUE\n";
        case Shading::combined:
            return "#define COMBINED\n";
        case Shading::sun:
            break;
    }
    return "";
}

bool has_overlays(const DrawSettings& settings) {
    return settings.layer != Layer::plain && !settings.overlays.empty();
}

/// Has shaders/light.glsl dusk or night there?
bool is_low(const SunSetting& sun, const geo::Geodetic& eye) {
    return std::sin(sun_at(sun, {eye.lat, eye.lon}).elevation.radians()) < 0.22;
}

}  // namespace

Renderer::Renderer(const lod::Terrain& terrain, GroundTextures ground, const GroundData& data)
    : terrain_(&terrain),
      ground_(std::make_unique<GroundTextures>(std::move(ground))),
      ocean_(std::make_unique<Ocean>(terrain, *ground_, data.heights)),
      data_(data) {}

Result<Renderer> Renderer::create(const lod::Terrain& terrain, const GroundData& data) {
    auto ground = GroundTextures::create(terrain, data);
    if (!ground) return ground.error();
    Renderer made(terrain, *std::move(ground), data);

    made.frame_ = GlBuffer::create();
    glNamedBufferStorage(made.frame_.name(), sizeof(FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    made.make_vertex_array();
    made.seen_ = GlQuery(create_gl_query(GL_ANY_SAMPLES_PASSED));
    const geo::GridFrame& grid = terrain.frame();
    made.base_undulation_m_ = static_cast<float>(
        terrain.undulations().at(geo::GridPosition{0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1)}));
    if (auto done = gl_check("preparing to draw"); !done) return done.error();
    return made;
}

GlName Renderer::ramp(const DrawSettings& settings) {
    const Layer layer = settings.layer;
    GlTexture& ramp = ramps_[layer];
    const bool is_tints = layer == Layer::hypsometric;
    if (ramp && (!is_tints || ramp_ == settings.ramp)) return ramp.name();
    if (is_tints) ramp_ = settings.ramp;
    const GroundFacts& facts = ground_->facts();
    const HeightSpan span{facts.lowest_m, facts.highest_m, facts.lowest_land_m};
    const bool is_own = is_tints && ramp_;
    const auto colours = is_own ? colours_of(*ramp_, span) : colour_ramp(layer, span);
    const auto sea = is_own ? colours : sea_ramp(span);
    ramp = GlTexture(create_gl_texture(GL_TEXTURE_2D));
    const GlName name = ramp.name();
    const auto width = static_cast<GLsizei>(colours.size());
    glTextureStorage2D(name, 1, GL_RGBA8, width, 2);
    glTextureSubImage2D(name, 0, 0, 0, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
    glTextureSubImage2D(name, 0, 0, 1, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, sea.data());
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return name;
}

void Renderer::make_vertex_array() {
    vertices_ = GlBuffer::create();
    indices_ = GlBuffer::create();
    no_vertices_ = GlVertexArray::create();
    vertex_array_ = GlVertexArray::create();
    const GlName array = vertex_array_.name();
    glVertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(lod::MeshVertex));
    glVertexArrayElementBuffer(array, indices_.name());
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(lod::MeshVertex, x));
    glVertexArrayAttribBinding(array, 0, 0);
    glEnableVertexArrayAttrib(array, 1);
    glVertexArrayAttribIFormat(array, 1, 2, GL_UNSIGNED_SHORT, offsetof(lod::MeshVertex, column));
    glVertexArrayAttribBinding(array, 1, 0);
}

Result<GlName> Renderer::sky_program(bool low_sun) {
    GlProgram& program = sky_programs_[low_sun ? 1 : 0];
    if (!program) {
        const std::string common =
            std::string(shader_text("frame.glsl")) + std::string(shader_text("light.glsl"));
        auto built = build_program({.name = "sky",
                                    .defines = low_sun ? "#define LOW_SUN\n" : "",
                                    .common = common,
                                    .vertex = shader_text("sky.vert"),
                                    .geometry = {},
                                    .fragment = shader_text("sky.frag")});
        if (!built) return built.error();
        program = std::move(*built);
    }
    return program.name();
}

Result<GlName> Renderer::terrain_program(const Variant& variant) {
    if (const auto known = terrain_programs_.find(variant); known != terrain_programs_.end()) {
        return known->second.name();
    }
    std::string defines = fmt::format("#define LAYER {}\n#define TOP_LEVEL {}\n",
                                      static_cast<int>(variant.layer), ground_->top());
    if (variant.nodes) defines += "#define NODES\n";
    if (variant.wireframe) defines += "#define WIREFRAME\n";
    defines += shading_define(variant.shading);
    if (variant.sun_fixed) defines += "#define SUN_FIXED\n";
    if (variant.sky) defines += "#define SKY\n";
    if (variant.probe) defines += "#define PROBE\n";
    if (ground_->facts().has_voids) defines += "#define VOIDS\n";
    if (const auto* polar = terrain_->positions().polar())
        defines += fmt::format("#define POLE {:.1f}\n", polar->plane().pole);
    const bool covered = variant.layer == Layer::terrain;
    defines += height_defines(ground_->facts());
    if (!variant.overlays.empty()) {
        defines += overlay_defines(variant.overlays, data_.drapes.size(), variant.areas);
        if (ground_->facts().has_sea && !variant.ocean) defines += "#define DRY_LINES\n";
    }
    if (variant.ocean) {
        defines += "#define OCEAN\n";
    } else if (ground_->facts().has_sea && (variant.layer == Layer::hypsometric || covered)) {
        defines += "#define TINTED_SEA\n";
    }
    std::string common(shader_text("frame.glsl"));
    if (covered) {
        defines += ground_->facts().has_sea ? "#define COVER\n#define SHORE\n" : "#define COVER\n";
        if (data_.map) defines += "#define GROUND_MAP\n";
        common += std::string(shader_text("light.glsl")) + std::string(shader_text("cover_block.glsl"));
    }
    if (!variant.overlays.empty()) common += shader_text("overlay_block.glsl");
    const bool plain = variant.layer == Layer::plain;
    if (plain) defines += "#define PLAIN\n";
    const std::string ground(shader_text("ground.glsl"));
    const std::string vertex = (plain ? ground : "") + std::string(shader_text("terrain.vert"));
    const std::string fragment = ground +
                                 std::string(variant.overlays.empty() ? "" : shader_text("overlays.glsl")) +
                                 std::string(variant.overlays.empty() ? "" : "#ifdef DRAPES\n") +
                                 std::string(variant.overlays.empty() ? "" : shader_text("drape.glsl")) +
                                 std::string(variant.overlays.empty() ? "" : "#endif\n") +
                                 std::string(covered ? shader_text("cover.glsl") : std::string_view{}) +
                                 std::string(variant.ocean ? shader_text("shore.glsl") : std::string_view{}) +
                                 std::string(shader_text(plain ? "plain.frag" : "terrain.frag"));
    auto program =
        build_program({.name = "terrain",
                       .defines = std::move(defines),
                       .common = common,
                       .vertex = vertex,
                       .geometry = variant.wireframe ? shader_text("terrain.geom") : std::string_view{},
                       .fragment = fragment});
    if (!program) return program.error();
    return terrain_programs_.emplace(variant, std::move(*program)).first->second.name();
}

void Renderer::upload(const DrawnGround& ground) {
    if (const auto* nodes = std::get_if<lod::ChunkPicture>(&ground)) {
        if (!nodes_) nodes_.emplace();
        nodes_->upload(*nodes);
        return;
    }
    nodes_.reset();  // what is not drawn keeps no memory
    const lod::Mesh& mesh = std::get<0>(ground);
    stream(vertices_, vertex_bytes_, mesh.vertices.data(), mesh.vertices.size() * sizeof(lod::MeshVertex));
    stream(indices_, index_bytes_, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
    index_count_ = static_cast<int>(mesh.indices.size());
}

Result<void> Renderer::provide_overlays(const DrawSettings& settings) {
    if (!has_overlays(settings)) {
        overlays_.reset();  // what is off keeps no memory
        return {};
    }
    if (!overlays_) overlays_.emplace(*terrain_, data_);
    return overlays_->provide(settings);
}

bool Renderer::ground_fits(const lod::View& view, const DrawSettings& settings, const PicturePart& part) {
    // What cannot be made is told where it is drawn.
    const bool drapes = provide_overlays(settings) && has_overlays(settings);
    const Sight sight(view, part);
    return ground_->fits(sight, settings.exaggeration) && (!drapes || overlays_->fits(settings, sight));
}

Result<void> Renderer::complete(const lod::View& view, const DrawSettings& settings,
                                const PicturePart& part) {
    if (auto done = provide_overlays(settings); !done) return done;
    if (has_overlays(settings)) {
        if (auto done = overlays_->complete(settings, sight_of(view, part, settings.layer)); !done)
            return done;
    }
    if (auto done = ground_->complete(sight_of(view, part, settings.layer), settings.exaggeration); !done)
        return done;
    return gl_check("loading the terrain's normals");
}

Renderer::Variant Renderer::variant(const DrawSettings& settings) const {
    return {.layer = settings.layer,
            .shading = is_shaded(settings.layer) ? settings.shading : Shading::sun,
            .nodes = nodes_.has_value(),
            .wireframe = settings.wireframe && settings.layer != Layer::plain,
            .sun_fixed = settings.sun.kind == SunSetting::Kind::time,
            .sky = !settings.background,
            .ocean = settings.ocean.kind != OceanKind::off && ground_->facts().has_sea,
            .probe = false,
            .overlays = drawn_overlays(settings, data_.drapes.size()),
            .areas = has_overlays(settings) ? overlays_->areas() : 1};
}

std::optional<bool> Renderer::is_below_ground(const geo::Geodetic& eye, double exaggeration) const {
    const geo::LatLon place{eye.lat, eye.lon};
    const geo::GridPosition at = terrain_->frame().grid_position(place);
    if (!terrain_->frame().contains(at)) return std::nullopt;
    // Higher than all posts none need be read: an eye that flies fast is over other ones at every frame.
    const double N = terrain_->undulations().at(at);
    if (eye.h.m > N + exaggeration * ground_->facts().highest_m) return false;
    const auto ground = ground_height(*terrain_, place, exaggeration);
    if (!ground) return std::nullopt;
    return eye.h < *ground;
}

void Renderer::prepare(const lod::View& view, const DrawSettings& settings, const PicturePart& part) {
    const geo::Geodetic& eye = view.camera().eye;
    const bool may_be_below =
        is_below_ground(eye, settings.exaggeration).value_or(eye.h.m < 10e3 * settings.exaggeration);
    const FrameBlock block =
        frame_block(view, *terrain_, {part.x, part.y, part.width, part.height}, settings.sun, settings.haze,
                    settings.exaggeration, base_undulation_m_, may_be_below);
    glNamedBufferSubData(frame_.name(), 0, sizeof(block), &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_.name());
    ground_->update(sight_of(view, part, settings.layer), settings.exaggeration);
    if (settings.layer == Layer::terrain) {
        if (!cover_) cover_.emplace(data_.map.get());
        cover_->update(terrain_->frame(), {view.camera().eye.lat, view.camera().eye.lon});
    }
    if (has_overlays(settings)) {
        overlays_->update(settings, sight_of(view, part, settings.layer));
    }
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);  // the ground is also seen from below
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
}

int Renderer::draw_terrain(GlName program, const lod::View& view, const DrawSettings& settings) {
    if (nodes_ ? nodes_->empty() : index_count_ == 0) return 0;
    glUseProgram(program);
    ground_->bind();
    if (settings.layer == Layer::terrain) cover_->bind();
    if (has_ramp(settings.layer)) glBindTextureUnit(kRampUnit, ramp(settings));
    if (has_overlays(settings)) overlays_->bind();
    glEnable(GL_CLIP_DISTANCE0);
    glEnable(GL_CLIP_DISTANCE1);
    int calls = 1;
    if (nodes_) {
        calls = nodes_->draw(view);
    } else {
        glBindVertexArray(vertex_array_.name());
        glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    }
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_CLIP_DISTANCE1);
    return calls;
}

Result<int> Renderer::fill(const lod::View& view, const DrawSettings& settings) {
    // Below the ground, where one looks past it from behind, there is nothing to fill.
    if (is_below_ground(view.camera().eye, settings.exaggeration).value_or(false)) return 0;
    return ocean_->fill();
}

Result<DrawFigures> Renderer::probe(const lod::View& view, const DrawSettings& settings) {
    DrawFigures figures;
    if (auto done = provide_overlays(settings); !done) return done.error();
    Variant probing = variant(settings);
    probing.wireframe = false;  // covers what the plain ground covers
    probing.probe = true;
    probing.overlays.clear();
    probing.areas = 1;
    const auto program = terrain_program(probing);
    if (!program) return program.error();
    prepare(view, settings, {0, 0, view.camera().width, view.camera().height});
    const auto ocean = ocean_->draw(view, settings.ocean, {.sun = settings.sun, .sky = false, .probe = true});
    if (!ocean) return ocean.error();
    figures.ocean = *ocean;
    figures.draw_calls = ocean->draw_calls;
    figures.draw_calls += draw_terrain(*program, view, settings);
    if (const auto filled = fill(view, settings); !filled) return filled.error();
    glBindVertexArray(0);
    glUseProgram(0);
    if (auto done = gl_check("probing the sea"); !done) return done.error();
    return figures;
}

Result<DrawFigures> Renderer::draw(const lod::View& view, const DrawSettings& settings,
                                   const RenderTarget& target, Region region, bool measured) {
    DrawFigures figures;
    if (auto done = provide_overlays(settings); !done) return done.error();
    const bool sky = !settings.background;
    if (has_overlays(settings)) overlays_->arrange(view, settings);
    const Variant drawn = variant(settings);
    const auto program = terrain_program(drawn);
    if (!program) return program.error();
    const bool low_sun = is_low(settings.sun, view.camera().eye);
    const auto sky_program_name = sky ? sky_program(low_sun) : GlName{0};
    if (!sky_program_name) return sky_program_name.error();
    prepare(view, settings, {region.x, region.y, target.width(), target.height()});

    const auto colour = settings.background.value_or(std::array<float, 3>{0, 0, 0});
    target.begin(colour[0], colour[1], colour[2]);
    // Before the ground: what lies under water is hidden by it, and need not be shaded.
    if (measured) {
        gl_finish();
        glBeginQuery(GL_ANY_SAMPLES_PASSED, seen_.name());
    }
    const auto start = std::chrono::steady_clock::now();
    Ocean::Look look{.sun = settings.sun, .sky = sky, .low_sun = low_sun};
    if (has_overlays(settings)) {
        look.overlays =
            overlay_defines(drawn.overlays, data_.drapes.size(), drawn.areas, OverlaidSurface::water);
        overlays_->bind();
    }
    const auto ocean = ocean_->draw(view, settings.ocean, look);
    if (!ocean) return ocean.error();
    figures.ocean = *ocean;
    if (measured && ocean->draw_calls > 0) {
        gl_finish();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        figures.ocean.draw_ms = took.count() - ocean->arrange_ms;
    }
    figures.draw_calls += ocean->draw_calls;
    figures.draw_calls += draw_terrain(*program, view, settings);
    const auto filled = fill(view, settings);
    if (!filled) return filled.error();
    figures.draw_calls += *filled;
    if (measured) glEndQuery(GL_ANY_SAMPLES_PASSED);
    if (sky) {
        // After the ground, and only where nothing was drawn: there depth is still 0.
        glDepthFunc(GL_EQUAL);
        glDepthMask(GL_FALSE);
        glUseProgram(*sky_program_name);
        glBindVertexArray(no_vertices_.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDepthMask(GL_TRUE);
        ++figures.draw_calls;
    }
    glBindVertexArray(0);
    glUseProgram(0);
    target.resolve();
    if (measured) {
        GLuint seen = 0;
        glGetQueryObjectuiv(seen_.name(), GL_QUERY_RESULT, &seen);
        figures.ground_seen = seen != 0;
    }
    if (auto done = gl_check("drawing"); !done) return done.error();
    return figures;
}

}  // namespace relevo::viewer
