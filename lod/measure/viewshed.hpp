#pragma once

#include <functional>

#include "lod/measure/sight.hpp"
#include "lod/scene/block_grid.hpp"

namespace relevo::lod {

struct ViewshedRequest {
    Looking looking;
    double radius_m = 0;                   ///< how far one looks, along the ellipsoid
    std::function<bool(double)> progress;  ///< told the part done, 0 to 1, from any thread; false stops it
};

/// What is seen from a place: for every post within a radius, whether a target over it is.
struct Viewshed {
    enum Seen : std::uint8_t {
        hidden = 0,
        visible = 1,
        unknown = 2,  ///< no known ground is in the way, but some of the line is over a void or outside
        none = 255,   ///< the post is a void, or farther than the radius
    };
    BlockGrid::Box box;  ///< the posts of the scene that `posts` has
    Raster<std::uint8_t> posts;
    double eye_H_m = 0;
    std::uint64_t visible_posts = 0;
    std::uint64_t hidden_posts = 0;
    std::uint64_t unknown_posts = 0;
    // On the ellipsoid, each post standing for the area halfway to its neighbours.
    double visible_m2 = 0;
    double hidden_m2 = 0;
    double unknown_m2 = 0;
};

/// The line of sight to every post ("R3" of Franklin and Ray 1994: no sector or interpolated horizon stands
/// for another line), over the same bilinear surface and with the same air as measure_sight. It agrees with
/// that but where the clearance is as small as 1e-3 posts times the slope across the line, or the line as
/// near to the border of the data or a void.
///
/// A line is divided in halves as long as some of the ground under it (a pyramid of highest heights) comes
/// up to it, down to pieces of two posts, which are followed exactly. In the grid a line is a cubic of the
/// distance through four places of its geodesic. On all cores; 12 bytes a post of the box, which may have 64
/// million.
///
/// Fails with ErrorKind::usage where the eye is not over known ground, the radius is none, has too many
/// posts, or is so large that lines are no cubics to 1e-3 posts (near a pole of a geographic grid). Posts on
/// the other side of where a grid round the earth closes are not looked at.
Result<Viewshed> measure_viewshed(HeightSampler& sampler, geo::LatLon eye, const ViewshedRequest& request);

}  // namespace relevo::lod
