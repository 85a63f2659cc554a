#include "viewer/eye_height.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

geo::Undulation EyeHeight::undulation(geo::LatLon place) const {
    if (!geoid_) return geo::Undulation{0};
    if (geoid_->covers(place)) return geoid_->undulation(place);
    if (!elsewhere_) elsewhere_.emplace(geo::Geoid::egm96());
    return *elsewhere_ ? (*elsewhere_)->undulation(place) : geoid_->undulation(place);
}

std::optional<geo::EllipsoidalHeight> ground_height(const lod::Terrain& terrain, geo::LatLon place,
                                                    double exaggeration) {
    const int last_column = terrain.frame().columns - 1;
    const int last_row = terrain.frame().rows - 1;
    const geo::GridPosition at = terrain.frame().grid_position(place);
    if (!terrain.frame().contains(at)) return std::nullopt;
    const int west = static_cast<int>(at.column);
    const int north = static_cast<int>(at.row);
    const int east = std::min(west + 1, last_column);
    const int south = std::min(north + 1, last_row);
    lod::TruePosts::Reader posts(terrain.posts());
    const auto H_at = [&](int column, int row) { return static_cast<double>(posts.H(column, row)); };
    const double x = at.column - west;
    const double y = at.row - north;
    const double H = (1 - y) * ((1 - x) * H_at(west, north) + x * H_at(east, north)) +
                     y * ((1 - x) * H_at(west, south) + x * H_at(east, south));
    if (std::isnan(H)) return std::nullopt;
    return geo::EllipsoidalHeight{terrain.undulations().at(at) + exaggeration * H};
}

}  // namespace relevo::viewer
