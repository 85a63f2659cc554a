#include "viewer/marks/scale_bar.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "geo/geodesic.hpp"

namespace relevo::viewer {

namespace {

/// Two places to both sides of one, as many metres apart, in the picture. Nothing behind the eye.
std::optional<double> length_px(const lod::View& view, const geo::Geodetic& middle, geo::Degrees across,
                                double metres) {
    glm::dvec2 ends[2];
    for (int i = 0; i < 2; ++i) {
        const geo::LatLon end = geo::geodesic_destination({middle.lat, middle.lon},
                                                          across + geo::Degrees{180.0 * i}, 0.5 * metres);
        const glm::dvec3 offset = geo::to_ecef({end.lat, end.lon, middle.h}) - view.eye();
        if (!(view.depth(offset) > lod::View::kNearM)) return std::nullopt;
        ends[i] = view.pixel(offset);
    }
    return glm::distance(ends[0], ends[1]);
}

}  // namespace

std::optional<ScaleBar> scale_bar(const lod::View& view, double distance_m, double most_px) {
    constexpr double kLevel = 0.5;
    const lod::Camera& camera = view.camera();
    const glm::dvec3 ray = view.ray({0.5 * camera.width, 0.5 * camera.height});
    const geo::Geodetic middle = geo::to_geodetic(view.eye() + distance_m * ray);
    const geo::EnuFrame there(middle);
    const double east = glm::dot(view.right(), there.east());
    const double north = glm::dot(view.right(), there.north());
    if (!(std::hypot(east, north) > kLevel) || !(most_px > 0)) return std::nullopt;
    const geo::Degrees across = geo::Degrees::from_radians(std::atan2(east, north));

    const double most_m = 1.1 * most_px * distance_m / view.focal_px();
    if (!(most_m > 0) || !std::isfinite(most_m)) return std::nullopt;
    double power = std::pow(10.0, std::floor(std::log10(most_m)));
    for (int i = 0; i < 3; ++i, power /= 10) {
        for (const double step : {5.0, 2.0, 1.0}) {
            const double metres = step * power;
            const auto length = metres <= most_m ? length_px(view, middle, across, metres) : std::nullopt;
            if (length && *length <= most_px) return ScaleBar{metres, *length, distance_m};
        }
    }
    return std::nullopt;
}

}  // namespace relevo::viewer
