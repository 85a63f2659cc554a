#pragma once

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "lod/scene/read_box.hpp"

namespace relevo::output {

/// An area in degrees; where west is east of east it lies across the antimeridian.
struct Bounds {
    double west = 0;
    double south = 0;
    double east = 0;
    double north = 0;
};

/// The posts of a grid that an area takes, snapped outwards: the smallest rectangle of posts that holds it,
/// cut off at the grid's border. Within 1e-6 of a post a side of the area is that post's row or column. In a
/// polar grid the rectangle around an area of latitude and longitude takes more than the area. Fails with
/// ErrorKind::usage where the area is none, has nothing in common with the grid, or lies on both sides of
/// where a grid round the earth closes.
Result<lod::BlockGrid::Box> posts_around(const geo::GridFrame& frame, const Bounds& bounds);

using lod::read_box;

/// A box of posts as a grid of its own.
geo::GridFrame frame_of(const geo::GridFrame& frame, const lod::BlockGrid::Box& box);

}  // namespace relevo::output
