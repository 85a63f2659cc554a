#include "ingest/mosaic/frame_plane.hpp"

#include <algorithm>
#include <cmath>

#include "ingest/mosaic/lattice.hpp"

namespace relevo::ingest {
namespace {

/// count places from 0 to last, both ends included (one where there is one post).
std::vector<double> spread(double last, int count) {
    if (last <= 0) return {0};
    std::vector<double> places;
    for (int i = 0; i < count; ++i) places.push_back(last * i / (count - 1));
    return places;
}

}  // namespace

void FramePlane::from_lon_lat(std::span<Place> places) const {
    if (!is_polar()) return;
    for (Place& p : places) {
        if (std::isnan(p.x)) continue;
        const auto at = unit_.grid_position({geo::Degrees{p.y}, geo::Degrees{p.x}});
        p = {at.column, -at.row};
    }
}

void FramePlane::to_lon_lat(std::span<Place> places) const {
    if (!is_polar()) return;
    for (Place& p : places) {
        const geo::LatLon at = unit_.lat_lon({p.x, -p.y});
        p = {at.lon.value, at.lat.value};
    }
}

std::vector<Place> lattice_of(const SourceMap& map, int count) {
    std::vector<Place> places;
    for (const double y : spread(map.rows() - 1, std::min(count, map.rows())))
        for (const double x : spread(map.columns() - 1, std::min(count, map.columns())))
            places.push_back({x, y});
    return places;
}

std::vector<Place> outline_of(const SourceMap& map, int count) {
    const double right = map.columns() - 1;
    const double bottom = map.rows() - 1;
    std::vector<Place> places;
    for (const double x : spread(right, std::min(map.columns(), count)))
        places.insert(places.end(), {{x, 0}, {x, bottom}});
    for (const double y : spread(bottom, std::min(map.rows(), count)))
        places.insert(places.end(), {{0, y}, {right, y}});
    return places;
}

std::optional<Bounds> extent_of(const SourceMap& map, const FramePlane& plane, int count) {
    auto places = outline_of(map, count);
    plane.from_posts(map, places);
    const auto undefined = [](Place p) { return std::isnan(p.x); };
    if (std::any_of(places.begin(), places.end(), undefined)) {
        // Outside of what the CRS can show, as at the corners of a world map: look inside as well.
        auto inside = lattice_of(map, 512);
        plane.from_posts(map, inside);
        places.insert(places.end(), inside.begin(), inside.end());
        std::erase_if(places, undefined);
    }
    if (places.empty()) return {};
    Bounds found{places[0].x, places[0].y, places[0].x, places[0].y};
    for (const Place& p : places) {
        found.west = std::min(found.west, p.x);
        found.east = std::max(found.east, p.x);
        found.south = std::min(found.south, p.y);
        found.north = std::max(found.north, p.y);
    }
    return found;
}

bool holds_pole(const SourceMap& map, double latitude) {
    std::vector<Place> pole{{0, latitude}, {90, latitude}, {180, latitude}, {-90, latitude}};
    map.from_lon_lat(pole);
    for (const Place& p : pole) {
        if (!(p.x > -0.5 && p.x < map.columns() - 0.5 && p.y > -0.5 && p.y < map.rows() - 0.5)) return false;
        if (std::hypot(p.x - pole[0].x, p.y - pole[0].y) > 1e-3) return false;
    }
    return true;
}

std::optional<Density> density_of(const SourceMap& map, const FramePlane& plane, std::span<const Place> at) {
    std::vector<Place> around;
    around.reserve(4 * at.size());
    for (const Place& p : at)
        around.insert(around.end(), {{p.x - 0.5, p.y}, {p.x + 0.5, p.y}, {p.x, p.y - 0.5}, {p.x, p.y + 0.5}});
    plane.from_posts(map, around);
    Density most;
    for (std::size_t i = 0; i < around.size(); i += 4) {
        const double x_column = around[i + 1].x - around[i].x;
        const double y_column = around[i + 1].y - around[i].y;
        const double x_row = around[i + 3].x - around[i + 2].x;
        const double y_row = around[i + 3].y - around[i + 2].y;
        const double determinant = std::abs(x_column * y_row - x_row * y_column);
        const double x_change = std::hypot(x_column, x_row);
        const double y_change = std::hypot(y_column, y_row);
        // At a pole longitudes have no slope; where a place is undefined nothing has.
        if (!(determinant > 1e-3 * x_change * y_change)) continue;
        most.x = std::max(most.x, y_change / determinant);
        most.y = std::max(most.y, x_change / determinant);
    }
    if (!(most.x > 0) || !(most.y > 0)) return {};
    return most;
}

std::optional<double> distance_from_plane(const PostGrid& grid, const FramePlane& plane) {
    const Affine& posts = grid.posts;
    const double step_x = std::abs(posts.x_column);
    const double step_y = std::abs(posts.y_row);
    constexpr double kSquare = 1e-6;  // posts
    const bool aligned = std::abs(posts.x_row) * grid.map.rows() <= kSquare * step_x &&
                         std::abs(posts.y_column) * grid.map.columns() <= kSquare * step_y;
    const bool same_unit = plane.is_polar()
                               ? !grid.crs->geographic() && grid.crs->unit_factor() == 1
                               : grid.crs->geographic() && std::abs(grid.crs->full_turn() - 360) < 1e-9;
    if (!aligned || !same_unit) return {};
    double largest = 0;
    const int count = grid.parts.size() <= 16 ? 17 : 3;
    for (const SourceMap& part : grid.parts) {
        const auto places = lattice_of(part, count);
        auto exact = places;
        plane.from_posts(part, exact);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Place p = part.posts().at(places[i]);
            const double x = plane.is_polar() ? exact[i].x - p.x : std::remainder(exact[i].x - p.x, 360.0);
            const double distance = std::max(std::abs(x) / step_x, std::abs(exact[i].y - p.y) / step_y);
            if (!(distance <= largest)) largest = distance;
        }
    }
    return largest;
}

}  // namespace relevo::ingest
