#include "viewer/overlay/overlay_drawing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "viewer/marks/marks.hpp"

namespace relevo::viewer {

namespace {

constexpr GLuint kOverlaysBinding = 5;  // as in shaders/overlays.glsl

bool is_draped(Overlay::Kind kind) {
    return kind == Overlay::Kind::imagery || kind == Overlay::Kind::vectors;
}

}  // namespace

std::vector<DrawnOverlay> drawn_overlays(const DrawSettings& settings, std::size_t drapes) {
    std::vector<DrawnOverlay> drawn;
    if (settings.layer == Layer::plain) return drawn;
    for (const Overlay& overlay : settings.overlays) {
        const bool of_file = is_draped(overlay.kind);
        // What is not there still counts: numbers in the block are those in the settings.
        const bool there = !of_file || static_cast<std::size_t>(overlay.file) < drapes;
        drawn.push_back({overlay.kind, there ? overlay.file : -1});
    }
    return drawn;
}

std::string overlay_defines(const std::vector<DrawnOverlay>& overlays, std::size_t drapes, int areas,
                            OverlaidSurface surface) {
    std::string once;
    std::string drawing;
    for (std::size_t i = 0; i < overlays.size(); ++i) {
        if (overlays[i].kind == Overlay::Kind::contours && surface == OverlaidSurface::ground) {
            if (once.find("CONTOURS") == std::string::npos) once += "#define CONTOURS\n";
            drawing += fmt::format(
                " shown = with_contours(shown, bright, overlays.drawn[{}], height, height_slope, dry);", i);
        }
        if (overlays[i].kind == Overlay::Kind::graticule) {
            once += fmt::format("#define GRATICULE overlays.drawn[{}]\n#define AREAS {}\n", i, areas);
            drawing += " shown = with_graticule(shown, bright, GRATICULE, graticule);";
        }
        if (is_draped(overlays[i].kind) && overlays[i].file >= 0) {
            const bool is_lines = overlays[i].kind == Overlay::Kind::vectors;
            drawing += fmt::format(
                " shown = with_drape(shown, overlays.drawn[{0}], {2}(drape_{1}, drape_table_{1}, "
                "overlays.drawn[{0}], OVERLAY_GRID, {3}apart) * OVERLAY_SHARE); bright = brightness(shown);",
                i, overlays[i].file, is_lines ? "lines_at_place" : "drape_at",
                is_lines ? "grid_steps, " : "");
        }
    }
    const bool any_draped = std::any_of(overlays.begin(), overlays.end(), [](const DrawnOverlay& overlay) {
        return is_draped(overlay.kind) && overlay.file >= 0;
    });
    if (any_draped) once += fmt::format("#define DRAPES {}\n", drapes);
    return once + "#define OVERLAYS" + drawing + "\n";
}

OverlayDrawing::OverlayDrawing(const lod::Terrain& terrain, const GroundData& data)
    : terrain_(&terrain),
      scale_(terrain),
      code_(height_code(data.facts)),
      block_(GlBuffer::create()),
      data_(data) {
    glNamedBufferStorage(block_.name(), sizeof(OverlayBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

Result<void> OverlayDrawing::provide(const DrawSettings& settings) {
    const auto drawn = drawn_overlays(settings, data_.drapes.size());
    std::erase_if(drapes_, [&](const auto& drape) {  // what is off keeps no memory
        return std::none_of(drawn.begin(), drawn.end(), [&](const DrawnOverlay& overlay) {
            return is_draped(overlay.kind) && overlay.file == drape.first;
        });
    });
    for (const auto& [kind, file] : drawn) {
        if (!is_draped(kind) || file < 0 || drapes_.count(file) != 0) continue;
        auto made = DrapeTextures::create(*terrain_, data_, data_.drapes[static_cast<std::size_t>(file)],
                                          data_.cache_bytes / 2 / data_.drapes.size());
        if (!made) return made.error();
        drapes_.emplace(file, *std::move(made));
    }
    return {};
}

Result<void> OverlayDrawing::complete(const DrawSettings& settings, const Sight& sight) {
    for (const auto& [kind, file] : drawn_overlays(settings, data_.drapes.size())) {
        if (!is_draped(kind) || file < 0) continue;
        if (auto done = drapes_.at(file).complete(sight, settings.exaggeration); !done) return done;
    }
    return {};
}

std::size_t OverlayDrawing::pending() const {
    std::size_t sum = 0;
    for (const int file : drawn_) sum += drapes_.at(file).pending();
    return sum;
}

bool OverlayDrawing::fits(const DrawSettings& settings, const Sight& sight) const {
    for (const auto& [kind, file] : drawn_overlays(settings, data_.drapes.size())) {
        const auto drape = drapes_.find(file);
        if (is_draped(kind) && drape != drapes_.end() && !drape->second.fits(sight, settings.exaggeration))
            return false;
    }
    return true;
}

OverlayDrawing::DrapeFigures OverlayDrawing::figures(int file) const {
    const auto drape = drapes_.find(file);
    if (drape == drapes_.end()) return {};
    return {drape->second.tiles(), DrapeTextures::kGlObjects, drape->second.bytes()};
}

void OverlayDrawing::update(const DrawSettings& settings, const Sight& sight) {
    drawn_.clear();
    for (const auto& [kind, file] : drawn_overlays(settings, data_.drapes.size())) {
        if (is_draped(kind) && file >= 0) drawn_.push_back(file);
    }
    for (const int file : drawn_) drapes_.at(file).update(sight, settings.exaggeration);
}

void OverlayDrawing::arrange(const lod::View& view, const DrawSettings& settings) {
    assert(settings.overlays.size() <= kMostOverlays);
    contour_interval_m_.reset();
    graticule_.reset();
    areas_ = 1;
    const lod::Camera& camera = view.camera();
    const double scale = marks_scale(camera.width, camera.height);
    // Of a window of the usual size: in a larger picture lines are wider, and as far apart for that.
    const double pixel_m = scale * scale_.pixel_m(view, settings.exaggeration);
    OverlayBlock block{};
    block.shape.x = static_cast<float>(scale);
    for (std::size_t i = 0; i < settings.overlays.size(); ++i) {
        const Overlay& overlay = settings.overlays[i];
        block.drawn[i].x = static_cast<float>(overlay.opacity);
        if (const auto drape = drapes_.find(overlay.file);
            is_draped(overlay.kind) && drape != drapes_.end()) {
            block.drawn[i].y = static_cast<float>(drape->second.top());
            block.drawn[i].z = static_cast<float>(1 << drape->second.finer());
            const auto colour = drape->second.drape().line_colour().value_or(std::array<std::uint8_t, 3>{});
            block.drawn[i].w = static_cast<float>((colour[0] << 16) + (colour[1] << 8) + colour[2]);
        }
        if (overlay.kind == Overlay::Kind::contours) {
            contour_interval_m_ = overlay.interval_m > 0 ? overlay.interval_m : contour_interval(pixel_m);
            const auto lines = contour_scale(code_, *contour_interval_m_);
            block.drawn[i].y = lines[0];
            block.drawn[i].z = lines[1];
        }
        if (overlay.kind == Overlay::Kind::graticule) {
            const auto polar = arrange_graticule(view, overlay.utm, pixel_m, block);
            block.drawn[i].y = polar.x;
            block.drawn[i].z = polar.y;
        }
    }
    glNamedBufferSubData(block_.name(), 0, sizeof(block), &block);
}

glm::vec2 OverlayDrawing::arrange_graticule(const lod::View& view, bool utm, double pixel_m,
                                            OverlayBlock& block) {
    const geo::GridFrame& grid = terrain_->frame();
    const geo::Geodetic& eye = view.camera().eye;
    const geo::LatLon below{eye.lat, eye.lon};
    graticule_ = suitable_graticule(utm, below, pixel_m);
    if (grid.is_polar()) graticule_->every_zone = false;
    if (grid.is_polar() && !utm) {
        constexpr double kDegrees = 180 / 3.14159265358979323846;
        return glm::dvec2(kDegrees) / graticule_->interval;
    }
    // To the horizon of the eye, and of what may stand up behind it.
    constexpr double kRadius = 6371e3;
    constexpr double kHighest = 9000;
    const double seen_m = std::sqrt(2 * kRadius * std::max(eye.h.m, 0.0)) + std::sqrt(2 * kRadius * kHighest);
    const double reach_m = std::clamp(500 * pixel_m, 50e3, 1000e3);
    const GraticuleTerms made = graticule_terms(*graticule_, grid, below, reach_m, seen_m);
    const geo::GridPosition nadir = grid.grid_position(below);
    block.anchor = glm::vec4(made.anchor, 1.0 / made.reach);
    block.shape.z = static_cast<float>(nadir.column - made.anchor.x);
    block.shape.w = static_cast<float>(nadir.row - made.anchor.y);
    for (std::size_t k = 0; k < made.areas.size(); ++k) {
        const GraticuleTerms::Area& area = made.areas[k];
        for (int side = 0; side < 4; ++side) {
            const auto at = static_cast<std::size_t>(side);
            block.bounds[k][side] = static_cast<float>(area.bounds[at]);
            block.borders[k][side] = area.is_border[at] ? 1.0f : 0.0f;
        }
        block.local[k] = glm::vec4(area.centre, 1.0 / area.reach);
        for (std::size_t i = 0; i < area.terms.size(); ++i)
            block.terms[k * area.terms.size() + i] = glm::vec4(glm::vec2(area.terms[i]), 0, 0);
    }
    // The others' bounds are empty.
    const std::size_t areas = made.areas.size();
    areas_ = areas <= 2 ? std::max(static_cast<int>(areas), 1) : areas <= 4 ? 4 : GraticuleTerms::kMostAreas;
    return {};
}

void OverlayDrawing::bind() const {
    for (const int file : drawn_) drapes_.at(file).bind(file);
    glBindBufferBase(GL_UNIFORM_BUFFER, kOverlaysBinding, block_.name());
}

}  // namespace relevo::viewer
