#pragma once

#include <vector>

#include "lod/scene/scene.hpp"
#include "lod/view.hpp"

namespace relevo::bench {

/// A straight flight from the south over the middle of a scene, a third of its relief above its highest
/// ground.
inline std::vector<lod::Camera> flight(const lod::Scene& scene, int frames) {
    const geo::GridFrame& frame = scene.info().frame;
    const double relief = scene.info().height_max_m - scene.info().height_min_m;
    std::vector<lod::Camera> cameras;
    for (int k = 0; k < frames; ++k) {
        const double along = static_cast<double>(k) / frames;
        const geo::LatLon place = frame.lat_lon({0.5 * frame.columns, (1.1 - 0.7 * along) * frame.rows});
        lod::Camera camera;
        camera.eye = {place.lat, place.lon, {scene.info().height_max_m + 0.3 * relief}};
        camera.pitch = geo::Degrees{-20};
        cameras.push_back(camera);
    }
    return cameras;
}

}  // namespace relevo::bench
