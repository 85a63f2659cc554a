#include "viewer/eye_height.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::viewer {

Result<EyeHeight> EyeHeight::create(lod::VerticalDatum datum) {
    EyeHeight made;
    if (datum == lod::VerticalDatum::ellipsoid) return made;
    auto geoid = geo::Geoid::egm96();
    if (!geoid) return geoid.error();
    made.geoid_ = std::move(*geoid);
    return made;
}

geo::Undulation EyeHeight::undulation(geo::LatLon place) const {
    return geoid_ ? geoid_->undulation(place) : geo::Undulation{0};
}

std::optional<geo::EllipsoidalHeight> ground_height(const lod::Terrain& terrain, geo::LatLon place,
                                                    double exaggeration) {
    const auto& heights = terrain.heights();
    const geo::GridPosition at = terrain.frame().grid_position(place);
    if (!(at.column >= 0 && at.row >= 0 && at.column <= heights.columns() - 1 &&
          at.row <= heights.rows() - 1)) {
        return std::nullopt;
    }
    const int west = static_cast<int>(at.column);
    const int north = static_cast<int>(at.row);
    const int east = std::min(west + 1, heights.columns() - 1);
    const int south = std::min(north + 1, heights.rows() - 1);
    const double x = at.column - west;
    const double y = at.row - north;
    const double H = (1 - y) * ((1 - x) * heights.at(west, north) + x * heights.at(east, north)) +
                     y * ((1 - x) * heights.at(west, south) + x * heights.at(east, south));
    if (std::isnan(H)) return std::nullopt;
    return geo::EllipsoidalHeight{terrain.undulations().at(at) + exaggeration * H};
}

}  // namespace relevo::viewer
