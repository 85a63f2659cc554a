#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geo/frame.hpp"
#include "ingest/mosaic/frame_choice.hpp"

namespace relevo::ingest {

/// The plane that a scene's grid is a lattice of: longitude and latitude in degrees, or easting and northing
/// of UPS in metres.
class FramePlane {
  public:
    explicit FramePlane(geo::FrameKind kind) {
        unit_.kind = kind;
        unit_.step_x = unit_.step_y = 1;
    }

    geo::FrameKind kind() const { return unit_.kind; }
    bool is_polar() const { return unit_.is_polar(); }

    /// From longitude and latitude, in place; longitudes stay in their turn.
    void from_lon_lat(std::span<Place> places) const;
    void to_lon_lat(std::span<Place> places) const;

    /// Places of a source's posts in the plane.
    void from_posts(const SourceMap& map, std::span<Place> posts) const {
        map.to_lon_lat(posts);
        from_lon_lat(posts);
    }

  private:
    geo::GridFrame unit_;  // posts are units
};

/// Places spread over a source's posts, `count` a side at most, its corners among them.
std::vector<Place> lattice_of(const SourceMap& map, int count);

/// Places on a source's outermost posts, at most `count` a side.
std::vector<Place> outline_of(const SourceMap& map, int count);

/// What a source covers in the plane; continuous. Nothing where it has no place there.
/// \param count  places looked at on each side
std::optional<Bounds> extent_of(const SourceMap& map, const FramePlane& plane, int count);

/// Is a pole one point inside the source (and not a whole side, as in geographic and cylindrical grids)?
bool holds_pole(const SourceMap& map, double latitude);

/// How many source posts one passes a unit of the plane along its axes, where that is most.
struct Density {
    double x = 0;
    double y = 0;
};
/// \param at  places of the source, in its posts
std::optional<Density> density_of(const SourceMap& map, const FramePlane& plane, std::span<const Place> at);

/// The largest distance, in steps, between the grid's posts taken as places of the plane as they are and
/// where they are on it; nothing for a grid that is no axis-aligned one in the plane's unit.
std::optional<double> distance_from_plane(const PostGrid& grid, const FramePlane& plane);

}  // namespace relevo::ingest
