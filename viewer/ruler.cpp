#include "viewer/ruler.hpp"

#include "viewer/eye_height.hpp"

namespace relevo::viewer {

void Ruler::add(const lod::PointMeasurement& point) {
    if (points_.size() == 2) points_.clear();
    points_.push_back(point);
}

std::optional<geo::GeodesicLine> Ruler::line() const {
    if (points_.size() < 2) return std::nullopt;
    return geo::geodesic(points_[0].place, points_[1].place);
}

std::vector<geo::Ecef> Ruler::on_ground(const lod::Terrain& terrain, double exaggeration) const {
    std::vector<geo::Ecef> positions;
    if (points_.empty()) return positions;
    geo::EllipsoidalHeight height{0};
    const auto add = [&](geo::LatLon place) {
        height = ground_height(terrain, place, exaggeration).value_or(height);
        positions.push_back(geo::to_ecef({place.lat, place.lon, height}));
    };
    add(points_[0].place);
    if (points_.size() < 2) return positions;
    constexpr int kParts = 200;
    const geo::GeodesicPath path(points_[0].place, points_[1].place);
    for (int i = 1; i < kParts; ++i) add(path.at(path.length_m() * i / kParts));
    add(points_[1].place);
    return positions;
}

}  // namespace relevo::viewer
