#include "viewer/camera.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relevo::viewer {

lod::Camera camera_of(const ViewState& view, const EyeHeight& heights, int width, int height) {
    return {.eye = {view.place.lat, view.place.lon, view.H + heights.undulation(view.place)},
            .heading = view.heading,
            .pitch = view.pitch,
            .roll = view.roll,
            .fov = view.fov,
            .width = width,
            .height = height};
}

void set_eye(ViewState& view, const EyeHeight& heights, const geo::Geodetic& eye) {
    view.place = {eye.lat, eye.lon};
    view.H = eye.h - heights.undulation(view.place);
}

namespace {

/// The view from a distance towards `target`. \param azimuth  from the eye, at the target
/// \param down  from level
void look_along(ViewState& view, const EyeHeight& heights, const geo::Geodetic& target, double distance,
                geo::Degrees azimuth, geo::Degrees down) {
    const geo::EnuFrame there(target);
    const double flat = distance * std::cos(down.radians());
    const geo::Geodetic eye = geo::to_geodetic(
        there.to_ecef({{-flat * std::sin(azimuth.radians()), -flat * std::cos(azimuth.radians()),
                        distance * std::sin(down.radians())}}));
    const glm::dvec3 to_target = glm::normalize(geo::EnuFrame(eye).from_ecef(there.origin()).m);
    set_eye(view, heights, eye);
    view.heading = geo::wrapped_360(geo::Degrees::from_radians(std::atan2(to_target.x, to_target.y)));
    view.pitch = geo::Degrees::from_radians(std::asin(std::clamp(to_target.z, -1.0, 1.0)));
}

}  // namespace

void look_at(ViewState& view, const EyeHeight& heights, const geo::Geodetic& target, double distance_m) {
    constexpr double kFlattest = 15;
    // Straight down there is no azimuth to be seen in the ray: the heading stays what it is.
    const geo::Degrees heading = view.heading;
    const geo::Degrees down{std::clamp(-view.pitch.value, kFlattest, 90.0)};
    look_along(view, heights, target, distance_m, heading, down);
    if (down.value > 89.9) view.heading = heading;
}

void look_over(ViewState& view, const lod::Terrain& terrain, const lod::SceneInfo& info,
               const EyeHeight& heights, int width, int height) {
    const geo::GridFrame& grid = terrain.frame();
    const double low = std::min(view.exaggeration * info.height_min_m, view.exaggeration * info.height_max_m);
    const double high =
        std::max(view.exaggeration * info.height_min_m, view.exaggeration * info.height_max_m);
    const auto at = [&](double across, double down, double H) {
        const geo::LatLon place = grid.lat_lon({across * (grid.columns - 1), down * (grid.rows - 1)});
        return geo::Geodetic{place.lat, place.lon, geo::OrthometricHeight{H} + heights.undulation(place)};
    };
    const geo::Geodetic target = at(0.5, 0.5, 0.5 * (low + high));

    const auto shows_all = [&](double distance) {
        look_along(view, heights, target, distance, geo::Degrees{0}, geo::Degrees{30});
        const lod::View seen(camera_of(view, heights, width, height));
        for (const double across : {0.0, 0.5, 1.0}) {
            for (const double down : {0.0, 0.5, 1.0}) {
                for (const double H : {low, high}) {
                    if (!seen.sees(geo::to_ecef(at(across, down, H)) - seen.eye())) return false;
                }
            }
        }
        return true;
    };
    // From too near something is out of the picture; from far enough everything is in it.
    double near = 50;
    double far = near;
    while (far < 5e7 && !shows_all(far)) far *= 2;
    for (int i = 0; i < 20 && far > 1.01 * near; ++i) {
        const double middle = 0.5 * (near + far);
        (shows_all(middle) ? far : near) = middle;
    }
    look_along(view, heights, target, far, geo::Degrees{0}, geo::Degrees{30});
    view.roll = geo::Degrees{0};
    // Nobody needs 17 digits of a view that we chose: a short string is easier to pass on.
    const auto rounded = [](double value, double parts) { return std::round(value * parts) / parts; };
    view.place = {geo::Degrees{rounded(view.place.lat.value, 1e6)},
                  geo::Degrees{rounded(view.place.lon.value, 1e6)}};
    view.H.m = rounded(view.H.m, 10);
    view.heading.value = geo::wrapped_360(geo::Degrees{rounded(view.heading.value, 100)}).value;
    view.pitch.value = rounded(view.pitch.value, 100);
}

}  // namespace relevo::viewer
