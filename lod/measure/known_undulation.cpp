#include "lod/measure/known_undulation.hpp"

namespace relevo::lod {

std::optional<geo::Undulation> known_undulation(const Scene& scene, geo::LatLon place) {
    const VerticalReference& vertical = scene.info().vertical;
    if (vertical.datum == VerticalDatum::ellipsoid) return geo::Undulation{0};
    const bool known = vertical.datum == VerticalDatum::egm96 || vertical.geoid_known;
    if (!known || scene.geoid() == nullptr || !scene.geoid()->covers(place)) return {};
    return scene.geoid()->undulation(place);
}

}  // namespace relevo::lod
