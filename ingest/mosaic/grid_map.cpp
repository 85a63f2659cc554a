#include "ingest/mosaic/grid_map.hpp"

#include <cassert>
#include <cmath>

namespace relevo::ingest {
namespace {

/// x moved by whole turns to within half a turn of the middle.
double unwrapped(double x, double middle, double turn) {
    return x - turn * std::round((x - middle) / turn);
}

}  // namespace

SourceMap::SourceMap(const Operation& operation, const Crs& crs, const Affine& posts, int columns, int rows)
    : operation_(operation), posts_(posts), columns_(columns), rows_(rows) {
    const auto inverse = posts.inverse();
    assert(inverse);
    inverse_ = *inverse;
    const Place middle = posts.at({0.5 * (columns - 1), 0.5 * (rows - 1)});
    middle_x_ = middle.x;
    if (crs.geographic()) full_turn_ = crs.full_turn();
    Place place = middle;
    operation.forward({&place, 1});
    if (std::isfinite(place.x)) middle_lon_ = place.x;
}

void SourceMap::to_lon_lat(std::span<Place> places) const {
    for (Place& place : places) place = posts_.at(place);
    operation_.forward(places);
    for (Place& place : places) place.x = unwrapped(place.x, middle_lon_, 360);
}

void SourceMap::from_lon_lat(std::span<Place> places) const {
    operation_.inverse(places);
    for (Place& place : places) {
        if (full_turn_ > 0) place.x = unwrapped(place.x, middle_x_, full_turn_);
        place = inverse_.at(place);
    }
}

void GridMap::to_source(std::span<Place> scene_posts) const {
    if (frame_.is_polar()) {
        for (Place& post : scene_posts) {
            const geo::LatLon at = frame_.lat_lon({post.x, post.y});
            post = {at.lon.value, at.lat.value};
        }
    } else {
        for (Place& post : scene_posts)
            post = {frame_.west + post.x * frame_.step_x, frame_.north - post.y * frame_.step_y};
    }
    source_.from_lon_lat(scene_posts);
}

void GridMap::to_scene(std::span<Place> source_posts) const {
    source_.to_lon_lat(source_posts);
    if (frame_.is_polar()) {
        for (Place& place : source_posts) {
            if (std::isnan(place.x)) continue;
            const auto at = frame_.grid_position({geo::Degrees{place.y}, geo::Degrees{place.x}});
            place = {at.column, at.row};
        }
        return;
    }
    // The frame's west is in [-180, 180) whichever turn the source's longitudes are in.
    const double middle = frame_.west + 0.5 * frame_.step_x * (frame_.columns - 1);
    for (Place& place : source_posts)
        place = {(unwrapped(place.x, middle, 360) - frame_.west) / frame_.step_x,
                 (frame_.north - place.y) / frame_.step_y};
}

}  // namespace relevo::ingest
