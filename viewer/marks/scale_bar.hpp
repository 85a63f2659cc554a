#pragma once

#include <optional>

#include "lod/view.hpp"

namespace relevo::viewer {

/// A bar that is as long as a round distance on the ground across the view, in the middle of the picture: in
/// a picture in perspective it holds there, and seen from straight above wherever the ground is as high.
struct ScaleBar {
    double metres = 0;      ///< 1, 2 or 5 times a power of ten
    double length_px = 0;   ///< of the bar
    double distance_m = 0;  ///< from the eye to what is in the middle
};

/// The longest that is no longer than `most_px`. Its ends, put to the left and right of the middle, are the
/// pictures of two places as high as the ground there, `metres` of geodesic apart on the ellipsoid, as
/// `relevo measure line` tells them. Nothing where the picture's rows are not level: a head that lies on its
/// side.
/// \param distance_m  along the ray through the picture's middle to the ground
std::optional<ScaleBar> scale_bar(const lod::View& view, double distance_m, double most_px);

}  // namespace relevo::viewer
