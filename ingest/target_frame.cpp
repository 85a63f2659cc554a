#include "ingest/target_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "geo/angle.hpp"
#include "ingest/interpolated_transform.hpp"
#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

constexpr double kSamePost = 1e-6;     // posts: closer than this is the same place
constexpr int kMostColumns = 1 << 30;  // of a frame, so that an absurd step is an error and not an overflow

/// count places from 0 to last, both ends included (one where there is one post).
std::vector<double> spread(double last, int count) {
    if (last <= 0) return {0};
    std::vector<double> places;
    for (int i = 0; i < count; ++i) places.push_back(last * i / (count - 1));
    return places;
}

std::vector<Place> lattice(const SourceMap& map, int count) {
    std::vector<Place> places;
    for (const double y : spread(map.rows() - 1, std::min(count, map.rows())))
        for (const double x : spread(map.columns() - 1, std::min(count, map.columns())))
            places.push_back({x, y});
    return places;
}

/// Places on the outermost posts, every post of a side up to 4096.
std::vector<Place> outline(const SourceMap& map) {
    const double right = map.columns() - 1;
    const double bottom = map.rows() - 1;
    std::vector<Place> places;
    for (const double x : spread(right, std::min(map.columns(), 4096)))
        places.insert(places.end(), {{x, 0}, {x, bottom}});
    for (const double y : spread(bottom, std::min(map.rows(), 4096)))
        places.insert(places.end(), {{0, y}, {right, y}});
    return places;
}

/// What the data covers in degrees; east above west, continuous.
std::optional<Bounds> extent(const SourceMap& map) {
    auto places = outline(map);
    map.to_lon_lat(places);
    const auto undefined = [](Place p) { return std::isnan(p.x); };
    if (std::any_of(places.begin(), places.end(), undefined)) {
        // Outside of what the CRS can show, as at the corners of a world map: look inside as well.
        auto inside = lattice(map, 512);
        map.to_lon_lat(inside);
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

/// Is a pole one point inside the source (and not a whole side, as in geographic and cylindrical grids)?
bool holds_pole(const SourceMap& map, double latitude) {
    std::vector<Place> pole{{0, latitude}, {90, latitude}, {180, latitude}, {-90, latitude}};
    map.from_lon_lat(pole);
    for (const Place& p : pole) {
        if (!(p.x > -0.5 && p.x < map.columns() - 0.5 && p.y > -0.5 && p.y < map.rows() - 0.5)) return false;
        if (std::hypot(p.x - pole[0].x, p.y - pole[0].y) > 1e-3) return false;
    }
    return true;
}

/// How many source posts one passes a degree of longitude, and a degree of latitude, where that is most.
struct Density {
    double per_lon = 0;
    double per_lat = 0;
};

std::optional<Density> density(const SourceMap& map, const std::vector<Place>& at) {
    Density most;
    for (const Place& p : at) {
        Place around[4] = {{p.x - 0.5, p.y}, {p.x + 0.5, p.y}, {p.x, p.y - 0.5}, {p.x, p.y + 0.5}};
        map.to_lon_lat(around);
        const double lon_column = around[1].x - around[0].x;
        const double lat_column = around[1].y - around[0].y;
        const double lon_row = around[3].x - around[2].x;
        const double lat_row = around[3].y - around[2].y;
        const double determinant = std::abs(lon_column * lat_row - lon_row * lat_column);
        const double lon_change = std::hypot(lon_column, lon_row);
        const double lat_change = std::hypot(lat_column, lat_row);
        // At a pole longitudes have no slope; where a place is undefined nothing has.
        if (!(determinant > 1e-3 * lon_change * lat_change)) continue;
        most.per_lon = std::max(most.per_lon, lat_change / determinant);
        most.per_lat = std::max(most.per_lat, lon_change / determinant);
    }
    if (!(most.per_lon > 0) || !(most.per_lat > 0)) return {};
    return most;
}

std::string text_of(const Bounds& b) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", b.west, b.south, b.east, b.north);
}

/// The part of the data's bounds that a crop leaves, whichever turn its longitudes are in.
Result<Bounds> cropped(const std::string& name, const Bounds& data, Bounds crop) {
    if (crop.east <= crop.west) crop.east += 360;
    if (!(crop.north >= crop.south) || crop.east - crop.west > 360)
        return Error{ErrorKind::usage, "--crop: W,S,E,N in degrees, with S < N"};
    const double turns =
        360 * std::round((0.5 * (data.west + data.east) - 0.5 * (crop.west + crop.east)) / 360);
    const Bounds left{std::max(crop.west + turns, data.west), std::max(crop.south, data.south),
                      std::min(crop.east + turns, data.east), std::min(crop.north, data.north)};
    if (left.west > left.east || left.south > left.north)
        return refusal(name, "--crop leaves nothing of it",
                       fmt::format("It covers W,S,E,N = {}", text_of(data)));
    return left;
}

/// Number of posts from 0 over a span, and the step that makes the last one its end.
struct Axis {
    double posts = 1;
    double step = 1;
};

Axis fitted(double span, double step) {
    if (span < kSamePost * step) return {1, step};
    const double cells = std::max(1.0, std::ceil(span / step - kSamePost));
    return {cells + 1, span / cells};
}

Axis fixed(double span, double step) {
    return {std::ceil(span / step - kSamePost) + 1, step};
}

Result<Target> own_grid(const std::string& name, const Affine& posts, const SourceMap& map,
                        const TargetRequest& request) {
    Target target;
    OwnWindow own{{0, 0, map.columns(), map.rows()}, posts.x_column<0, posts.y_row> 0};
    const double step_x = std::abs(posts.x_column);
    const double step_y = std::abs(posts.y_row);
    double west = own.flip_columns ? posts.x0 + posts.x_column * (map.columns() - 1) : posts.x0;
    double north = own.flip_rows ? posts.y0 + posts.y_row * (map.rows() - 1) : posts.y0;
    if (request.crop) {
        const Bounds all{west, north - step_y * (map.rows() - 1), west + step_x * (map.columns() - 1), north};
        const auto part = cropped(name, all, *request.crop);
        if (!part) return part.error();
        const int first_column = static_cast<int>(std::ceil((part->west - west) / step_x - kSamePost));
        const int last_column = static_cast<int>(std::floor((part->east - west) / step_x + kSamePost));
        const int first_row = static_cast<int>(std::ceil((north - part->north) / step_y - kSamePost));
        const int last_row = static_cast<int>(std::floor((north - part->south) / step_y + kSamePost));
        if (last_column < first_column || last_row < first_row)
            return refusal(name, "--crop leaves nothing of it: it lies between its posts",
                           "Take a larger part");
        own.window.columns = last_column - first_column + 1;
        own.window.rows = last_row - first_row + 1;
        own.window.column = own.flip_columns ? map.columns() - 1 - last_column : first_column;
        own.window.row = own.flip_rows ? map.rows() - 1 - last_row : first_row;
        west += step_x * first_column;
        north -= step_y * first_row;
    }
    geo::GridFrame& frame = target.frame;
    // Only where it must be: a sum with a whole turn would round.
    frame.west = west >= -180 && west < 180 ? west : geo::wrapped_180(geo::Degrees{west}).value;
    frame.north = north;
    frame.step_x = step_x;
    frame.step_y = step_y;
    frame.columns = own.window.columns;
    frame.rows = own.window.rows;
    target.own = own;
    return target;
}

/// Largest distance between the source's posts as degrees of WGS 84 and as what its CRS makes of them, in
/// steps.
std::optional<double> distance_from_wgs84(const Crs& crs, const Affine& posts, const SourceMap& map) {
    const bool degrees = crs.geographic() && std::abs(crs.full_turn() - 360) < 1e-9;
    const double step_x = std::abs(posts.x_column);
    const double step_y = std::abs(posts.y_row);
    const bool aligned = std::abs(posts.x_row) * map.rows() <= kSamePost * step_x &&
                         std::abs(posts.y_column) * map.columns() <= kSamePost * step_y;
    if (!degrees || !aligned) return {};
    const auto places = lattice(map, 17);
    auto exact = places;
    map.to_lon_lat(exact);
    double largest = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place p = posts.at(places[i]);
        const double lon = std::remainder(exact[i].x - p.x, 360.0);
        const double distance = std::max(std::abs(lon) / step_x, std::abs(exact[i].y - p.y) / step_y);
        if (!(distance <= largest)) largest = distance;
    }
    return largest;
}

bool is_own_resolution(const Affine& posts, const TargetRequest& request) {
    if (!request.resolution) return true;
    return std::abs(request.resolution->first / std::abs(posts.x_column) - 1) < 1e-9 &&
           std::abs(request.resolution->second / std::abs(posts.y_row) - 1) < 1e-9;
}

/// Source posts at which the density is taken: all over it, or all over what a crop leaves.
std::vector<Place> density_places(const SourceMap& map, const std::optional<Bounds>& crop) {
    if (!crop) return lattice(map, 33);
    std::vector<Place> places;
    for (int j = 0; j <= 64; ++j)
        for (int i = 0; i <= 64; ++i)
            places.push_back({crop->west + (crop->east - crop->west) * i / 64.0,
                              crop->south + (crop->north - crop->south) * j / 64.0});
    map.from_lon_lat(places);
    std::erase_if(places, [&](Place p) {
        return !(p.x >= -0.5 && p.x <= map.columns() - 0.5 && p.y >= -0.5 && p.y <= map.rows() - 0.5);
    });
    return places;
}

Result<Target> resampled_grid(const std::string& name, SourceMap& map, const TargetRequest& request) {
    std::optional<Bounds> covered;
    if (holds_pole(map, 90) || holds_pole(map, -90)) {
        if (!request.crop)
            return refusal(
                name,
                "it has a pole inside, where a grid of latitudes and longitudes cannot hold it, and "
                "polar grids are not there yet",
                "Take a part beside the pole with --crop W,S,E,N in degrees");
        map.set_middle_lon(0.5 * (request.crop->west + request.crop->east) +
                           (request.crop->east <= request.crop->west ? 180 : 0));
        covered = Bounds{map.middle_lon() - 180, -90, map.middle_lon() + 180, 90};
    } else {
        covered = extent(map);
    }
    if (!covered) return refusal(name, "none of its posts has a place on earth", "Check the CRS (--crs)");
    std::optional<Bounds> crop;
    if (request.crop) {
        const auto part = cropped(name, *covered, *request.crop);
        if (!part) return part.error();
        crop = covered = *part;
    }
    const auto most = density(map, density_places(map, crop));
    if (!most) return refusal(name, "it has no place on earth there", "Check --crs, --bounds and --crop");

    Target target;
    const double width = covered->east - covered->west;
    const double height = covered->north - covered->south;
    const Axis x =
        request.resolution ? fixed(width, request.resolution->first) : fitted(width, 1 / most->per_lon);
    const Axis y =
        request.resolution ? fixed(height, request.resolution->second) : fitted(height, 1 / most->per_lat);
    if (!(x.posts < kMostColumns) || !(y.posts < kMostColumns))
        return refusal(name, "its grid would have too many posts",
                       "Check --crs and --bounds, or give --resolution");
    geo::GridFrame& frame = target.frame;
    frame.west = geo::wrapped_180(geo::Degrees{covered->west}).value;
    frame.north = covered->north;
    frame.step_x = x.step;
    frame.step_y = y.step;
    frame.columns = static_cast<int>(x.posts);
    frame.rows = static_cast<int>(y.posts);
    target.downsamples = x.step * most->per_lon > 1.01 || y.step * most->per_lat > 1.01;
    return target;
}

}  // namespace

Result<Target> choose_target(const std::string& name, const Crs& crs, const Affine& posts, SourceMap& map,
                             const TargetRequest& request) {
    const auto distance = distance_from_wgs84(crs, posts, map);
    const bool own = distance && *distance <= kPositionTolerance && is_own_resolution(posts, request);
    auto target = own ? own_grid(name, posts, map, request) : resampled_grid(name, map, request);
    if (!target) return target;
    if (own && *distance > kSamePost)
        target->notes.push_back(
            fmt::format("its posts are kept as WGS 84, which moves them by {:.2g} of a step", *distance));
    const geo::GridFrame& frame = target->frame;
    const double south = frame.north - frame.step_y * (frame.rows - 1);
    if (frame.north > 90 + kSamePost * frame.step_y || (own && south < -90 - kSamePost * frame.step_y))
        return refusal(
            name, fmt::format("it has posts beyond a pole (latitudes {:.6f} to {:.6f})", south, frame.north),
            "Check --crs and --bounds");
    if (frame.step_x * (frame.columns - 1) > 360 + kSamePost * frame.step_x)
        return refusal(name, "it goes more than once round the earth", "Take a part with --crop W,S,E,N");
    return target;
}

}  // namespace relevo::ingest
