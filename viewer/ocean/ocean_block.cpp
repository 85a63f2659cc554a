#include "viewer/ocean/ocean_block.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relevo::viewer {

namespace {

glm::vec4 vec4(const glm::dvec3& v, double w = 0) {
    return {glm::vec3(v), static_cast<float>(w)};
}

/// Column and row of a place, and posts a radian, or a unit of the plane around a pole.
glm::dvec4 grid_of(const lod::Terrain& terrain, geo::LatLon place) {
    const geo::GridFrame& grid = terrain.frame();
    const geo::GridPosition at = grid.grid_position(place);
    if (const auto* polar = terrain.positions().polar()) {
        const auto plane = polar->plane();
        return {at.column, at.row, plane.y_column, plane.x_row};
    }
    return {at.column, at.row, 1 / geo::Degrees{grid.step_x}.radians(),
            1 / geo::Degrees{grid.step_y}.radians()};
}

glm::dvec3 to_sun(const SunSetting& sun, const geo::Geodetic& eye) {
    const geo::SunDirection at = sun_at(sun, {eye.lat, eye.lon});
    const geo::EnuFrame local(eye);
    const double flat = std::cos(at.elevation.radians());
    return flat * std::sin(at.azimuth.radians()) * local.east() +
           flat * std::cos(at.azimuth.radians()) * local.north() +
           std::sin(at.elevation.radians()) * local.up();
}

}  // namespace

OceanBlock ocean_block(const lod::SeaView& sea, double sea_h_m, double reach, const lod::Waves& waves,
                       const Ripples& ripples, const lod::Terrain& terrain, const OceanSettings& settings,
                       const SunSetting& sun) {
    const geo::Geodetic& eye = sea.view.camera().eye;
    const lod::SeaChart& chart = sea.chart;
    const glm::dvec2 nadir = sea.nadir / chart.radius_m();
    OceanBlock block{};
    block.anchor_east = vec4(chart.east(), nadir.x);
    block.anchor_north = vec4(chart.north(), nadir.y);
    block.anchor_up = vec4(chart.up(), 1 / chart.radius_m());
    block.nadir_up = vec4(sea.up, sea.eye_m);
    block.nadir_east = vec4(sea.east);
    block.nadir_north = vec4(sea.north);
    block.level = glm::dvec4(sea_h_m, sea.reach_m, reach, static_cast<double>(waves.components().size()));
    block.grid = grid_of(terrain, {eye.lat, eye.lon});
    const geo::GridFrame& grid = terrain.frame();
    const auto spacing = grid.spacing({0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1)});
    const glm::dvec3 light = to_sun(sun, eye);
    const double daylight = std::clamp((glm::dot(light, sea.up) + 0.10) / 0.25, 0.0, 1.0);
    block.sun = vec4(light, daylight * daylight * (3 - 2 * daylight));
    block.slopes = glm::dvec4(lod::cox_munk_slope_variance(settings.wind.speed_m_s),
                              std::min(spacing.column_m, spacing.row_m), 0, 0);
    for (int layer = 0; layer < Ripples::kLayers; ++layer) {
        const double tile = Ripples::tile_m(layer);
        const double turned = Ripples::turned(layer);
        const glm::dvec2 east(std::cos(turned), std::sin(turned));
        const glm::dvec2 in_tile =
            glm::dvec2(glm::dot(sea.nadir, east), east.x * sea.nadir.y - east.y * sea.nadir.x) / tile;
        block.ripples[static_cast<std::size_t>(layer)] = glm::dvec4(glm::fract(in_tile), east / tile);
        block.steepest[static_cast<std::size_t>(layer)] =
            glm::vec4(static_cast<float>(ripples.steepest(layer)));
    }
    for (std::size_t i = 0; i < waves.components().size(); ++i) {
        const lod::WaveComponent& wave = waves.components()[i];
        // In double, so that phases are right after hours and far from the anchor.
        const double phase =
            std::remainder(glm::dot(wave.k, sea.nadir) -
                               std::fmod(wave.omega * settings.time_s, 2 * std::numbers::pi) + wave.phase,
                           2 * std::numbers::pi);
        block.waves[2 * i] = glm::dvec4(wave.k, wave.amplitude_m, phase);
        block.waves[2 * i + 1] = glm::dvec4(wave.length_m(), 0, 0, 0);
    }
    return block;
}

}  // namespace relevo::viewer
