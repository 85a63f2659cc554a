#include "viewer/ocean/ocean.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lod/ocean/geoclipmap.hpp"
#include "lod/ocean/projected_mesh.hpp"
#include "lod/ocean/radial_grid.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/gl/gl_program.hpp"
#include "viewer/ocean/ocean_block.hpp"

namespace relevo::viewer {

namespace {

// As in shaders/ocean*.
constexpr GLuint kOceanBinding = 1;
constexpr GLuint kMeshBinding = 2;
constexpr GLuint kUndulationUnit = 5;
constexpr GLuint kRipplesUnit = 6;

/// Texels a side, odd: the nadir's is in the middle. They are as far apart from each other as from the nadir,
/// over 16: bilinear between them, N is right to centimetres out to 10 km.
constexpr int kUndulations = 33;
constexpr double kUndulationReach = 0.5 * (kUndulations - 1) / kUndulations;

double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// `off` is the grid that fills what the others leave.
std::string_view vertex_shader(OceanKind kind) {
    switch (kind) {
        case OceanKind::radial:
        case OceanKind::off:
            return "ocean_radial.vert";
        case OceanKind::projected:
            return "ocean_projected.vert";
        default:
            return "ocean_geoclipmap.vert";
    }
}

std::unique_ptr<lod::OceanMesh> make_mesh(OceanKind kind) {
    switch (kind) {
        case OceanKind::radial:
        case OceanKind::off:
            return std::make_unique<lod::RadialGrid>();
        case OceanKind::projected:
            return std::make_unique<lod::ProjectedMesh>();
        default:
            return std::make_unique<lod::Geoclipmap>();
    }
}

geo::LatLon middle_of(const geo::GridFrame& grid) {
    return grid.lat_lon({0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1)});
}

}  // namespace

void OceanFigures::add(const OceanFigures& other) {
    if (other.kind != OceanKind::off) kind = other.kind;
    vertices += other.vertices;
    triangles += other.triangles;
    draw_calls += other.draw_calls;
    arrange_ms += other.arrange_ms;
    draw_ms += other.draw_ms;
}

OceanKind chosen(OceanKind kind, const lod::SeaView& sea, const lod::SeaSpacing& spacing) {
    if (kind != OceanKind::automatic) return kind;
    return lod::ProjectedMesh::serves(sea, spacing) ? OceanKind::projected : OceanKind::radial;
}

Ocean::Ocean(const lod::Terrain& terrain, const GroundTextures& ground, const EyeHeight* heights)
    : terrain_(&terrain),
      ground_(&ground),
      heights_(heights),
      middle_(middle_of(terrain.frame())),
      water_(terrain.frame(), ground.top()) {}

double Ocean::wave_height(const glm::dvec2& at, double time_s) const {
    return map_ ? map_->height(at, time_s) : waves_.height(at, time_s);
}

double Ocean::sea_height(geo::LatLon place) const {
    return heights_ ? heights_->undulation(place).m : 0;
}

void Ocean::update_water() {
    const GroundPages& pages = ground_->pages();
    if (pages.shown() == water_of_) return;
    water_of_ = pages.shown();
    std::vector<WaterPages::Shown> shown;
    for (const auto& [page, slot] : water_of_) shown.push_back({page, &pages.sea(slot)});
    water_.fill(shown);
}

lod::Water Ocean::water_in(const lod::SeaView& sea, const glm::dvec2& centre, double radius_m) const {
    const geo::GridFrame& grid = terrain_->frame();
    const geo::LatLon place = sea.chart.place(sea.nadir + centre);
    const geo::GridPosition at = grid.grid_position(place);
    const double angle = geo::Degrees::from_radians(1.1 * radius_m / sea.radius_m).value;
    double columns = INFINITY;
    double rows = INFINITY;
    if (!grid.is_polar()) {
        rows = angle / grid.step_y;
        const double poleward = std::abs(place.lat.value) + angle;
        if (poleward < 89.9) columns = angle / std::cos(geo::Degrees{poleward}.radians()) / grid.step_x;
    } else if (angle < 30) {
        // The plane's scale grows by less out to 30 degrees from any place of the data.
        columns = 2 * radius_m / grid.step_x;
        rows = 2 * radius_m / grid.step_y;
    }
    // Beyond the data the sea goes on as it is on the border.
    const double last_column = grid.columns - 1;
    const double last_row = grid.rows - 1;
    const double turn = grid.is_polar() ? INFINITY : 360 / grid.step_x;
    const double north = std::clamp(at.row - rows, 0.0, last_row);
    const double south = std::clamp(at.row + rows, 0.0, last_row);
    WaterPages::Content all;
    const auto add = [&](double west, double east) {
        const WaterPages::Content part =
            water_.in({std::clamp(west, 0.0, last_column), north, std::clamp(east, 0.0, last_column), south});
        all = {all.sea || part.sea, all.land || part.land};
    };
    const double west = at.column - columns;
    const double east = at.column + columns;
    add(west, east);
    const double middle = 0.5 * last_column;
    if (west < middle - 0.5 * turn) add(west + turn, east + turn);
    if (east > middle + 0.5 * turn) add(west - turn, east - turn);
    if (!all.sea) return lod::Water::none;
    return all.land ? lod::Water::shore : lod::Water::open;
}

void Ocean::update_waves(const OceanSettings& settings) {
    if (settings.map != map_) {
        map_ = settings.map;
        map_error_.reset();
        map_texture_.reset();
        if (map_) map_error_.emplace(*map_);
    }
    const lod::Wind& wind = settings.wind;
    const auto same = [](const lod::Wind& a, const lod::Wind& b) {
        return a.speed_m_s == b.speed_m_s && a.from == b.from && a.fetch_m == b.fetch_m;
    };
    if (wind_ && same(*wind_, wind)) return;
    wind_ = wind;
    waves_ = lod::Waves::of_wind(wind);
    ripples_.emplace(wind);
    ripples_baked_ = false;
}

lod::SeaSpacing Ocean::spacing(const lod::View& view, double error_px) const {
    constexpr double kRadius = 6371e3;
    const double focal_px = lod::height_px(view);
    if (!map_) return {waves_, focal_px, error_px, kRadius};
    return {[this](double spacing_m) { return map_error_->at(spacing_m); }, map_error_->longest_m(), focal_px,
            error_px, kRadius};
}

void Ocean::make_objects() {
    if (map_ && !map_texture_) map_texture_.emplace(*map_);
    if (block_) return;
    block_ = GlBuffer::create();
    glNamedBufferStorage(block_.name(), sizeof(OceanBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    mesh_block_ = GlBuffer::create();
    glNamedBufferStorage(mesh_block_.name(), lod::OceanPicture::kMostNumbers * sizeof(glm::vec4), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    undulation_ = GlTexture(create_gl_texture(GL_TEXTURE_2D));
    glTextureStorage2D(undulation_.name(), 1, GL_R32F, kUndulations, kUndulations);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTextureParameteri(undulation_.name(), filter, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(undulation_.name(), axis, GL_CLAMP_TO_EDGE);
    ripple_tiles_ = GlTexture(create_gl_texture(GL_TEXTURE_2D_ARRAY));
    glTextureStorage3D(ripple_tiles_.name(), 1, GL_RG8, Ripples::kSide, Ripples::kSide, Ripples::kLayers);
    glTextureParameteri(ripple_tiles_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

void Ocean::bake_ripples(double time_s) {
    if (ripples_baked_ && time_s == ripples_time_s_) return;
    std::vector<std::uint8_t> texels;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int layer = 0; layer < Ripples::kLayers; ++layer) {
        ripples_->bake(layer, time_s, texels);
        glTextureSubImage3D(ripple_tiles_.name(), 0, 0, 0, layer, Ripples::kSide, Ripples::kSide, 1, GL_RG,
                            GL_UNSIGNED_BYTE, texels.data());
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    ripples_time_s_ = time_s;
    ripples_baked_ = true;
}

void Ocean::update_undulation(const lod::SeaView& sea, double sea_h_m) {
    std::vector<float> texels;
    constexpr int kMiddle = kUndulations / 2;
    for (int y = -kMiddle; y <= kMiddle; ++y) {
        for (int x = -kMiddle; x <= kMiddle; ++x) {
            const glm::dvec2 part = glm::dvec2(x, y) / static_cast<double>(kMiddle);
            const glm::dvec2 at = part * std::min(glm::length(part), 1.0) * sea.reach_m;
            texels.push_back(static_cast<float>(sea_height(sea.chart.place(sea.nadir + at)) - sea_h_m));
        }
    }
    glTextureSubImage2D(undulation_.name(), 0, 0, 0, kUndulations, kUndulations, GL_RED, GL_FLOAT,
                        texels.data());
}

void Ocean::use_mesh(OceanKind kind, std::unique_ptr<lod::OceanMesh> mesh) {
    buffers_.erase(kind);
    meshes_[kind] = std::move(mesh);
}

const lod::OceanMesh& Ocean::mesh(OceanKind kind) {
    std::unique_ptr<lod::OceanMesh>& made = meshes_[kind];
    if (!made) made = make_mesh(kind);
    return *made;
}

MeshBuffers& Ocean::buffers(OceanKind kind) {
    return buffers_.try_emplace(kind, mesh(kind)).first->second;
}

Result<GlName> Ocean::program(const Variant& variant) {
    if (const auto known = programs_.find(variant); known != programs_.end()) return known->second.name();
    std::string defines =
        fmt::format("#define TOP_LEVEL {}\n", ground_->top()) + height_defines(ground_->facts());
    if (variant.fill) defines += "#define FILL\n";
    if (ground_->facts().has_voids) defines += "#define VOIDS\n";
    if (variant.shore) defines += "#define SHORE\n";
    if (variant.sky) defines += "#define SKY\n";
    if (variant.probe) defines += "#define PROBE\n";
    if (variant.map) defines += "#define WAVE_MAP\n";
    if (!ground_->facts().sea_is_level) defines += "#define BED\n";
    if (const auto* polar = terrain_->positions().polar())
        defines += fmt::format("#define POLE {:.1f}\n", polar->plane().pole);
    std::string common;
    if (variant.low_sun) defines += "#define LOW_SUN\n";
    defines += variant.overlays;
    const bool overlaid = !variant.overlays.empty();
    for (const char* file : {"frame.glsl", "light.glsl", "ground.glsl", "shore.glsl", "ocean.glsl"})
        common += shader_text(file);
    if (overlaid) common += shader_text("overlay_block.glsl");
    std::string vertex(shader_text(vertex_shader(variant.kind)));
    if (variant.map) vertex += shader_text("wave_map.glsl");
    vertex += shader_text("ocean.vert");
    std::string fragment;
    if (overlaid) {
        fragment += std::string(shader_text("overlays.glsl")) + "#ifdef DRAPES\n" +
                    std::string(shader_text("drape.glsl")) + "#endif\n";
    }
    fragment += shader_text("ocean.frag");
    auto made = build_program({.name = "ocean",
                               .defines = std::move(defines),
                               .common = common,
                               .vertex = vertex,
                               .geometry = {},
                               .fragment = fragment});
    if (!made) return made.error();
    return programs_.emplace(variant, std::move(*made)).first->second.name();
}

Result<OceanFigures> Ocean::draw(const lod::View& view, const OceanSettings& settings, const Look& look) {
    const auto start = std::chrono::steady_clock::now();
    OceanFigures figures;
    last_.shore = false;
    if (settings.kind == OceanKind::off || !ground_->facts().has_sea) return figures;
    const geo::Geodetic& eye = view.camera().eye;
    const geo::LatLon place{eye.lat, eye.lon};
    const double sea_h_m = sea_height(place);
    const double eye_m = eye.h.m - sea_h_m;
    update_waves(settings);
    const lod::SeaSpacing spacing = this->spacing(view, settings.error_px);
    // Where no wave is to be seen, the chart may follow the eye: it is undistorted there.
    const bool waves_seen = !spacing.flat_from(std::max(std::abs(eye_m) - crest_m(), 0.1));
    chart_.emplace(waves_seen ? lod::sea_chart_anchor(middle_, place) : place);
    const lod::SeaView sea(view, *chart_, sea_h_m, crest_m(),
                           wave_height(chart_->at(place), settings.time_s));

    update_water();
    const lod::WaterIn has_water = [&](const glm::dvec2& centre, double radius) {
        return water_in(sea, centre, radius);
    };
    if (has_water({0, 0}, sea.reach_m) == lod::Water::none) return figures;
    const OceanKind kind = chosen(settings.kind, sea, spacing);
    lod::OceanPicture picture;
    mesh(kind).arrange(sea, spacing, has_water, picture);
    const auto seen = [](const auto& copies) { return !copies.open.empty() || !copies.shore.empty(); };
    if (std::none_of(picture.copies.begin(), picture.copies.end(), seen)) return figures;

    make_objects();
    bake_ripples(settings.time_s);
    update_undulation(sea, sea_h_m);
    const bool map = waves_seen && map_;
    const auto open_water =
        program({kind, false, look.sky, look.low_sun, look.probe, map, false, look.overlays});
    if (!open_water) return open_water.error();
    const auto shore = program({kind, true, look.sky, look.low_sun, look.probe, map, false, look.overlays});
    if (!shore) return shore.error();
    const OceanBlock block =
        ocean_block(sea, sea_h_m, kUndulationReach, waves_seen && !map_ ? waves_ : lod::Waves(), *ripples_,
                    *terrain_, settings, look.sun);
    glNamedBufferSubData(block_.name(), 0, sizeof(block), &block);
    figures.kind = kind;
    figures.arrange_ms = ms_since(start);

    if (map_) map_texture_->update(*map_, sea.nadir, settings.time_s);
    MeshBuffers& drawn = bind(kind, picture);
    // Ground at the sea's own level loses.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0, 16);
    const auto draw_runs = [&](const std::vector<MeshBuffers::Run>& runs, GlName with) {
        glUseProgram(with);
        for (const MeshBuffers::Run& run : runs) {
            drawn.draw(run);
            ++figures.draw_calls;
            figures.triangles += drawn.triangles(run);
            figures.vertices += drawn.vertices(run);
        }
    };
    draw_runs(drawn.runs().open, *open_water);
    draw_runs(drawn.runs().shore, *shore);
    glDisable(GL_POLYGON_OFFSET_FILL);

    last_.variant = {OceanKind::off, true, look.sky, look.low_sun, look.probe, false, true, look.overlays};
    last_.shore = !drawn.runs().shore.empty();
    if (last_.shore) {
        const lod::SeaSpacing still(lod::Waves(), lod::height_px(view), 0.5, sea.radius_m);
        mesh(OceanKind::off)
            .arrange(
                sea, still, [](const glm::dvec2&, double) { return lod::Water::shore; }, last_.flat);
    }
    return figures;
}

MeshBuffers& Ocean::bind(OceanKind kind, const lod::OceanPicture& picture) {
    MeshBuffers& drawn = buffers(kind);
    drawn.upload(picture);
    drawn.bind();
    glNamedBufferSubData(mesh_block_.name(), 0,
                         static_cast<GLsizeiptr>(picture.numbers.size() * sizeof(glm::vec4)),
                         picture.numbers.data());
    glBindBufferBase(GL_UNIFORM_BUFFER, kOceanBinding, block_.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kMeshBinding, mesh_block_.name());
    ground_->bind();
    glBindTextureUnit(kUndulationUnit, undulation_.name());
    glBindTextureUnit(kRipplesUnit, ripple_tiles_.name());
    if (map_) map_texture_->bind();
    return drawn;
}

Result<int> Ocean::fill() {
    if (!last_.shore) return 0;
    const auto with = program(last_.variant);
    if (!with) return with.error();
    const MeshBuffers& flat = bind(OceanKind::off, last_.flat);
    glUseProgram(*with);
    // Behind all that has been drawn, in front of what has not.
    glDepthRange(0, 1e-20);
    for (const MeshBuffers::Run& run : flat.runs().shore) flat.draw(run);
    glDepthRange(0, 1);
    return static_cast<int>(flat.runs().shore.size());
}

}  // namespace relevo::viewer
