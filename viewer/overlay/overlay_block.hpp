#pragma once

#include <array>

#include <glm/vec4.hpp>

#include "viewer/ground/height_code.hpp"
#include "viewer/overlay/graticule.hpp"
#include "viewer/overlay/overlay.hpp"

namespace relevo::viewer {

/// The uniform block of shaders/overlays.glsl (std140).
struct OverlayBlock {
    /// Opacity; of contours what a texel's height is times, and what is added to it, so that lines are at
    /// whole numbers; of latitudes in a polar grid lines a radian.
    std::array<glm::vec4, kMostOverlays> drawn;
    glm::vec4 anchor;  ///< the graticule's: column and row; 1 / reach
    glm::vec4 shape;   ///< how many times as wide as in a window lines are; the nadir's place less the anchor
    static constexpr std::size_t kAreas = GraticuleTerms::kMostAreas;
    std::array<glm::vec4, kAreas> bounds;
    std::array<glm::vec4, kAreas> borders;  ///< 1 where a side is one
    std::array<glm::vec4, kAreas> local;    ///< centre; 1 / reach
    std::array<glm::vec4, kAreas * GraticuleTerms::kTerms * GraticuleTerms::kTerms> terms;
};

/// Contours every so many metres: the second and third number of their entry.
///
/// A height that is a line's own counts as above the line, as in gdal_contour; a quarter of the heights' step
/// keeps rounding out of that. Lines are counted from the multiple of five that is nearest to the middle of
/// the scene's heights: whole numbers stay small, and every fifth the one whose height is 0, 5, 10 intervals.
std::array<float, 2> contour_scale(const HeightCode& code, double interval_m);

}  // namespace relevo::viewer
