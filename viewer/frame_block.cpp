#include "viewer/frame_block.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "geo/ellipsoid.hpp"

namespace relevo::viewer {

namespace {

/// Clip space of the whole picture to clip space of the window in it.
glm::dmat4 crop(const lod::Camera& camera, const Window& window) {
    const double scale_x = static_cast<double>(camera.width) / window.width;
    const double scale_y = static_cast<double>(camera.height) / window.height;
    const double middle_x = (2.0 * window.x + window.width) / camera.width - 1;
    const double middle_y = 1 - (2.0 * window.y + window.height) / camera.height;
    glm::dmat4 matrix(1);
    matrix[0][0] = scale_x;
    matrix[1][1] = scale_y;
    matrix[3][0] = -scale_x * middle_x;
    matrix[3][1] = -scale_y * middle_y;
    return matrix;
}

/// \param up_azimuth  of the direction whose part comes second
glm::dvec3 sun_along(const geo::SunDirection& sun, geo::Degrees up_azimuth) {
    const double flat = std::cos(sun.elevation.radians());
    const double azimuth = (sun.azimuth - up_azimuth).radians();
    return {flat * std::sin(azimuth), flat * std::cos(azimuth), std::sin(sun.elevation.radians())};
}

/// Where a light of a given azimuth comes from, along the grid's row, up its column, and up. In a polar grid
/// it comes from one side everywhere, as on a map, from the one that the azimuth means in the middle of the
/// data: by each place's own north it would whirl around the pole.
glm::dvec3 lamp_in_grid(const geo::SunDirection& sun, const geo::GridFrame& grid) {
    const geo::LatLon middle = grid.lat_lon({0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1)});
    return sun_along(sun, grid.up_azimuth(middle.lon));
}

glm::dvec4 place_of(const lod::Terrain& terrain) {
    if (const auto* polar = terrain.positions().polar()) {
        const auto plane = polar->plane();
        return {plane.x, plane.y, plane.x_row, plane.y_column};
    }
    const geo::GridFrame& grid = terrain.frame();
    return {geo::Degrees{grid.west}.radians(), geo::Degrees{grid.north}.radians(),
            geo::Degrees{grid.step_x}.radians(), geo::Degrees{grid.step_y}.radians()};
}

glm::vec4 vec4(const glm::dvec3& v, double w = 0) {
    return {glm::vec3(v), static_cast<float>(w)};
}

}  // namespace

FrameBlock frame_block(const lod::View& view, const lod::Terrain& terrain, const Window& window,
                       const SunSetting& sun, const Haze& haze, double exaggeration, double base_m,
                       bool may_be_below) {
    const lod::Camera& camera = view.camera();
    const geo::EnuFrame local(camera.eye);
    const geo::GridFrame& grid = terrain.frame();
    FrameBlock block{};

    // Crop in the exact picture: clip.xy gets a multiple of w, which is clip space's fourth row.
    const glm::dmat4 projection(view.projection());
    block.clip_from_offset = glm::mat4(crop(camera, window) * projection * glm::dmat4(view.to_eye_space()));
    block.eye_up = vec4(local.up(), camera.eye.h.m - base_m);
    block.grid = glm::dvec4(grid.columns - 1, grid.rows - 1, std::max(grid.columns - 2, 0),
                            std::max(grid.rows - 2, 0));
    block.place = place_of(terrain);

    const auto here = sun_at(sun, {camera.eye.lat, camera.eye.lon});
    const glm::dvec3 to_sun = sun_along(here, geo::Degrees{0});  // in east, north, up
    const double daylight = std::clamp((to_sun.z + 0.10) / 0.25, 0.0, 1.0);
    const glm::dvec3 to_sun_ecef = to_sun.x * local.east() + to_sun.y * local.north() + to_sun.z * local.up();
    const bool fixed = sun.kind == SunSetting::Kind::time;
    block.sun =
        vec4(fixed ? to_sun_ecef : lamp_in_grid(here, grid), daylight * daylight * (3 - 2 * daylight));
    block.sun_at_eye = vec4(to_sun_ecef, to_sun.z);
    block.surface = glm::dvec4(exaggeration, terrain.levels(), haze.extinction(), may_be_below ? 1 : 0);

    // The ray through the window's middle and its change to the window's right and upper edge.
    const double tan_x = 0.5 * camera.width / view.focal_px();
    const double tan_y = 0.5 * camera.height / view.focal_px();
    const double middle_x = (2.0 * window.x + window.width) / camera.width - 1;
    const double middle_y = 1 - (2.0 * window.y + window.height) / camera.height;
    block.ray = vec4(view.forward() + middle_x * tan_x * view.right() + middle_y * tan_y * view.up());
    block.ray_right = vec4(view.right() * (tan_x * window.width / camera.width));
    block.ray_up = vec4(view.up() * (tan_y * window.height / camera.height));

    const double a = geo::wgs84::kSemiMajor + base_m;
    const double b = geo::wgs84::kSemiMinor + base_m;
    const glm::dvec3 scaled = view.eye().m / glm::dvec3(a, a, b);
    block.eye_scaled = vec4(scaled, glm::dot(scaled, scaled) - 1);
    block.base_axes = vec4(glm::dvec3(1, 1, a / b));
    return block;
}

}  // namespace relevo::viewer
