#include "viewer/overlay_drawing.hpp"

#include <cassert>
#include <cmath>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "viewer/overlay_block.hpp"

namespace relevo::viewer {

namespace {

constexpr GLuint kOverlaysBinding = 5;  // as in shaders/overlays.glsl

}  // namespace

std::string overlay_defines(const std::vector<Overlay::Kind>& overlays) {
    std::string once;
    std::string drawing;
    for (std::size_t i = 0; i < overlays.size(); ++i) {
        if (overlays[i] == Overlay::Kind::contours) {
            if (once.find("CONTOURS") == std::string::npos) once += "#define CONTOURS\n";
            drawing += fmt::format(
                " shown = with_contours(shown, overlays.drawn[{}], height, height_slope, dry);", i);
        }
        if (overlays[i] == Overlay::Kind::graticule) {
            once += fmt::format("#define GRATICULE overlays.drawn[{}]\n", i);
            drawing += " shown = with_graticule(shown, GRATICULE, graticule, graticule_slope);";
        }
    }
    return once + "#define OVERLAYS" + drawing + "\n";
}

OverlayDrawing::OverlayDrawing(const lod::Terrain& terrain, const GroundFacts& facts)
    : terrain_(&terrain), scale_(terrain), code_(height_code(facts)), block_(GlBuffer::create()) {
    glNamedBufferStorage(block_.name(), sizeof(OverlayBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void OverlayDrawing::update(const lod::View& view, const DrawSettings& settings) {
    assert(settings.overlays.size() <= kMostOverlays);
    contour_interval_m_.reset();
    graticule_.reset();
    const double pixel_m = scale_.pixel_m(view, settings.exaggeration);
    OverlayBlock block{};
    for (std::size_t i = 0; i < settings.overlays.size(); ++i) {
        const Overlay& overlay = settings.overlays[i];
        block.drawn[i].x = static_cast<float>(overlay.opacity);
        if (overlay.kind == Overlay::Kind::contours) {
            contour_interval_m_ = overlay.interval_m > 0 ? overlay.interval_m : contour_interval(pixel_m);
            const auto scale = contour_scale(code_, *contour_interval_m_);
            block.drawn[i].y = scale[0];
            block.drawn[i].z = scale[1];
        }
        if (overlay.kind == Overlay::Kind::graticule) {
            const geo::GridFrame& grid = terrain_->frame();
            const geo::LatLon below{view.camera().eye.lat, view.camera().eye.lon};
            graticule_ = suitable_graticule(overlay.utm, below, pixel_m);
            if (grid.is_polar() && !overlay.utm) {
                constexpr double kDegrees = 180 / 3.14159265358979323846;
                block.drawn[i].y = static_cast<float>(kDegrees / graticule_->interval.x);
                block.drawn[i].z = static_cast<float>(kDegrees / graticule_->interval.y);
                continue;
            }
            const GraticuleTerms terms = graticule_terms(*graticule_, grid, below);
            block.anchor = glm::vec4(terms.anchor, 1.0 / terms.reach);
            for (std::size_t k = 0; k < terms.terms.size(); ++k)
                block.terms[k] = glm::vec4(glm::vec2(terms.terms[k]), 0, 0);
        }
    }
    glNamedBufferSubData(block_.name(), 0, sizeof(block), &block);
}

void OverlayDrawing::bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, kOverlaysBinding, block_.name());
}

}  // namespace relevo::viewer
