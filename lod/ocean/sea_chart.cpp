#include "lod/ocean/sea_chart.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "geo/ellipsoid.hpp"

namespace relevo::lod {

namespace {

glm::dvec3 normal_at(geo::LatLon place) {
    const double lat = place.lat.radians();
    const double lon = place.lon.radians();
    return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

/// sqrt(M N): that of the sphere that fits best.
double mean_radius(double sin_lat) {
    return geo::wgs84::kSemiMinor / (1 - geo::wgs84::kEccentricity2 * sin_lat * sin_lat);
}

}  // namespace

SeaChart::SeaChart(geo::LatLon anchor)
    : anchor_(anchor),
      east_(-std::sin(anchor.lon.radians()), std::cos(anchor.lon.radians()), 0),
      up_(normal_at(anchor)),
      radius_m_(mean_radius(up_.z)) {
    north_ = glm::cross(up_, east_);
}

glm::dvec2 SeaChart::at(geo::LatLon place) const {
    const glm::dvec3 n = normal_at(place);
    const glm::dvec2 flat(glm::dot(n, east_), glm::dot(n, north_));
    const double sine = glm::length(flat);
    const double angle = std::atan2(sine, glm::dot(n, up_));
    return flat * (sine > 0 ? angle / sine : 1.0) * radius_m_;
}

glm::dvec3 SeaChart::normal(const glm::dvec2& at) const {
    const double angle = glm::length(at) / radius_m_;
    const double sinc = angle > 0 ? std::sin(angle) / angle : 1;
    return up_ * std::cos(angle) + (east_ * at.x + north_ * at.y) * (sinc / radius_m_);
}

geo::LatLon SeaChart::place(const glm::dvec2& at) const {
    const glm::dvec3 n = normal(at);
    return {geo::Degrees::from_radians(std::asin(std::clamp(n.z, -1.0, 1.0))),
            geo::Degrees::from_radians(std::atan2(n.y, n.x))};
}

geo::LatLon sea_chart_anchor(geo::LatLon middle, geo::LatLon eye) {
    constexpr double kStep = 10;  // degrees of latitude
    const double rows = std::round((eye.lat.value - middle.lat.value) / kStep);
    const double lat = std::clamp(middle.lat.value + kStep * rows, -90.0, 90.0);
    const double step = kStep / std::max(std::cos(geo::Degrees{lat}.radians()), 1.0 / 36);
    const double around = std::remainder(eye.lon.value - middle.lon.value, 360.0);
    return {geo::Degrees{lat}, geo::Degrees{middle.lon.value + step * std::round(around / step)}};
}

}  // namespace relevo::lod
