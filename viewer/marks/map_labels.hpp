#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/overlay/graticule.hpp"

namespace relevo::viewer {

/// A text that belongs to a line in the picture.
struct MapLabel {
    glm::dvec2 pixel{0};  ///< its middle, from the picture's upper left corner
    double angle = 0;     ///< degrees by which its line of letters falls to the right, -90 to 90
    std::string text;
};

struct LabelOptions {
    double exaggeration = 1;
    double apart_px = 180;  ///< no two labels are nearer than this
    int most = 24;          ///< labels
};

/// Heights of the index lines, every fifth contour, where these cross the picture: "1500 m". Each lies on its
/// line and along it; upright, spread over the picture, away from its edges, and none where lines are too
/// close for letters.
///
/// It looks through a raster of about 120 pixels at the full data as far as it is in memory (lod::pick), and
/// from these follows the ground to the line: within a pixel of it, or there is no label. The same view gives
/// the same labels. Some 200 rays, 15 to 40 us each: for a window, ten times a second are enough.
std::vector<MapLabel> contour_labels(const lod::Terrain& terrain, const lod::View& view, double interval_m,
                                     const LabelOptions& options = {});

/// What is written on a graticule's lines where these cross the picture's lower and left edge: upright, a
/// little inside. Of the ground that is there; some 60 rays.
std::vector<MapLabel> graticule_labels(const lod::Terrain& terrain, const lod::View& view,
                                       const Graticule& graticule, const LabelOptions& options = {});

}  // namespace relevo::viewer
