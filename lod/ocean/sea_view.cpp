#include "lod/ocean/sea_view.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "geo/ellipsoid.hpp"

namespace relevo::lod {

namespace {

/// Angle at the sphere's centre from a point's foot to its horizon.
double dip(double radius_m, double height_m) {
    return std::acos(radius_m / (radius_m + std::max(height_m, 0.0)));
}

}  // namespace

double horizon_m(double radius_m, double height_m, double crest_m) {
    return radius_m * (dip(radius_m, std::abs(height_m)) + dip(radius_m, crest_m));
}

double height_px(const View& view) {
    const Camera& camera = view.camera();
    const glm::dvec3 up = geo::EnuFrame(camera.eye).up();
    constexpr int kRays = 16;
    double most = 0;
    for (int y = 0; y <= kRays; ++y) {
        for (int x = 0; x <= kRays; ++x) {
            const glm::dvec2 pixel(x * camera.width / double{kRays}, y * camera.height / double{kRays});
            const glm::dvec3 ray = view.ray(pixel);
            if (glm::dot(ray, up) > 0.05) continue;
            const double sine = glm::length(up - ray * glm::dot(ray, up));  // of the angle between the two
            if (sine < 1e-3) continue;
            const double depth = view.depth(ray);
            const glm::dvec2 moved =
                glm::dvec2(glm::dot(up, view.right()), glm::dot(up, view.up())) * depth -
                glm::dvec2(glm::dot(ray, view.right()), glm::dot(ray, view.up())) * view.depth(up);
            most = std::max(most, view.focal_px() * glm::length(moved) / (depth * depth * sine));
        }
    }
    return most > 0 ? most : view.error_scale().lambda_px;
}

SeaView::SeaView(const View& view_, const SeaChart& chart_, double sea_h_m, double crest, double wave_m)
    : view(view_), chart(chart_), crest_m(crest) {
    const geo::Geodetic& eye = view.camera().eye;
    nadir = chart.at({eye.lat, eye.lon});
    up = chart.normal(nadir);
    const double step = 1;  // metre
    east = chart.normal(nadir + glm::dvec2(step, 0)) - chart.normal(nadir - glm::dvec2(step, 0));
    east = glm::normalize(east - up * glm::dot(up, east));
    north = glm::cross(up, east);
    radius_m = geo::wgs84::kSemiMinor / (1 - geo::wgs84::kEccentricity2 * up.z * up.z) + sea_h_m;
    eye_m = eye.h.m - sea_h_m;
    clear_m = std::max(std::abs(eye_m - wave_m), kLeastClear);
    reach_m = horizon_m(radius_m, eye_m, crest_m);
}

double SeaView::error_distance_m(double along_m) const {
    // D over the sine of the angle between the line of sight and the vertical, along / D; least at 45
    // degrees.
    const double along = std::max(along_m, clear_m);
    return (along * along + clear_m * clear_m) / along;
}

glm::dvec3 SeaView::offset(const glm::dvec2& at, double height_m) const {
    const double angle = glm::length(at) / radius_m;
    const double along = (radius_m + height_m) * (angle > 0 ? std::sin(angle) / angle : 1) / radius_m;
    const double half = std::sin(0.5 * angle);
    const double rise = height_m * std::cos(angle) - 2 * radius_m * half * half - eye_m;
    return (east * at.x + north * at.y) * along + up * rise;
}

}  // namespace relevo::lod
