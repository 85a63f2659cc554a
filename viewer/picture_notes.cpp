#include "viewer/picture_notes.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "geo/ellipsoid.hpp"
#include "lod/soar/pick.hpp"
#include "viewer/camera.hpp"

namespace relevo::viewer {

namespace {

/// Does a ray meet the ellipsoid in front of its origin?
bool meets_earth(const geo::Ecef& origin, const glm::dvec3& ray) {
    const glm::dvec3 scale(1 / geo::wgs84::kSemiMajor, 1 / geo::wgs84::kSemiMajor,
                           1 / geo::wgs84::kSemiMinor);
    const glm::dvec3 from = origin.m * scale;
    const glm::dvec3 along = ray * scale;
    const double a = glm::dot(along, along);
    const double b = glm::dot(from, along);
    return b < 0 && b * b > a * (glm::dot(from, from) - 1);
}

std::string place_in(const lod::Terrain& terrain, const EyeHeight& heights, const lod::View& view,
                     const glm::dvec2& pixel, double exaggeration) {
    const glm::dvec3 ray = view.ray(pixel);
    const auto hit = lod::pick_exactly(terrain, view.eye(), ray, exaggeration);
    if (!hit) return meets_earth(view.eye(), ray) ? "no data" : "sky";
    geo::LatLon place = terrain.frame().lat_lon(hit->place);
    place.lon = geo::wrapped_180(place.lon);
    const auto h = ground_height(terrain, place, 1);
    std::string text = fmt::format("{:.8f},{:.8f}", place.lat.value, place.lon.value);
    if (h) text += fmt::format(",{:.2f}", h->m - heights.undulation(place).m);
    return text;
}

}  // namespace

PictureNotes picture_notes(const lod::Scene& scene, const lod::Terrain& terrain, const EyeHeight& heights,
                           const ViewState& state, int width, int height) {
    const lod::View view(camera_of(state, heights, width, height));
    const geo::Geodetic& eye = view.camera().eye;
    const lod::VerticalReference& vertical = scene.info().vertical;
    PictureNotes notes;
    notes.description = to_string(state);
    const auto add = [&](const char* key, std::string value) { notes.texts.emplace_back(key, value); };
    const auto number = [&](const char* key, double value, int decimals) {
        add(key, fmt::format("{:.{}f}", value + 0.0, decimals));
    };
    add("crs", "EPSG:4979");
    add("vertical_datum", vertical.name + (vertical.assumed ? " (assumed)" : ""));
    number("eye_lat_deg", eye.lat.value, 9);
    number("eye_lon_deg", geo::wrapped_180(eye.lon).value, 9);
    number("eye_ellipsoidal_height_m", eye.h.m, 3);
    number("eye_height_m", state.H.m, 3);
    number("heading_deg", geo::wrapped_360(state.heading).value, 6);
    number("pitch_deg", state.pitch.value, 6);
    number("roll_deg", state.roll.value, 6);
    number("vertical_fov_deg", state.fov.value, 6);
    add("size_px", fmt::format("{}x{}", width, height));
    const double w = width;
    const double h = height;
    const std::array<std::pair<const char*, glm::dvec2>, 5> places{{{"ground_centre", {0.5 * w, 0.5 * h}},
                                                                    {"ground_upper_left", {0, 0}},
                                                                    {"ground_upper_right", {w, 0}},
                                                                    {"ground_lower_right", {w, h}},
                                                                    {"ground_lower_left", {0, h}}}};
    for (const auto& [key, pixel] : places)
        add(key, place_in(terrain, heights, view, pixel, state.exaggeration));
    const auto sun = sun_at(state.sun, {eye.lat, eye.lon});
    add("sun", state.sun.text);
    number("sun_azimuth_deg", geo::wrapped_360(sun.azimuth).value, 3);
    number("sun_elevation_deg", sun.elevation.value, 3);
    add("layer", std::string(to_string(state.layer)));
    add("exaggeration", fmt::format("{}", state.exaggeration));
    add("scene", scene.path().filename().string());
    std::string sources;
    for (const lod::SourceInfo& source : scene.info().sources)
        sources += (sources.empty() ? "" : "; ") + source.name;
    add("sources", sources);
    return notes;
}

}  // namespace relevo::viewer
