#pragma once

#include <array>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "lod/view.hpp"
#include "viewer/ground/page_bounds.hpp"

namespace relevo::viewer {

/// A part of a view's picture, in pixels from its upper left corner.
struct PicturePart {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// What a part of a picture sees: where, and how finely.
class Sight {
  public:
    /// \param pixels  that a texel may be wide
    Sight(const lod::View& view, const PicturePart& part, double pixels = 1);

    /// May any of a sphere be in the part?
    bool sees(const glm::dvec3& centre, double radius_m) const;

    /// The least length across the ray that a pixel has at any point of a sphere, metres; 0 or less where the
    /// eye is inside.
    double finest_pixel_m(const glm::dvec3& centre, double radius_m) const;

  private:
    glm::dvec3 eye_;
    glm::dvec3 forward_;
    std::array<glm::dvec3, 4> planes_;
    double focal_px_;
    double least_cosine_;  // of the angle between the view's direction and one in the part
};

struct WantedPages {
    std::vector<Page> pages;  ///< the most urgent first; none before its parent
    bool complete = true;     ///< else there was no room for all
    bool damaged = false;     ///< some are left out because they are damaged
};

/// The pages that a picture is drawn from: at each place those of the levels that its texels come from, or
/// finer ones: by distance alone, as if all ground faced the eye. (Which of them a texel comes from, about
/// as large as a pixel, the shader chooses.) Parents of wanted pages are wanted, the top always. Where there
/// is room for fewer pages, the texels that are largest on the screen are made smaller first.
/// \param most     pages, at least 1
/// \param damaged  pages that cannot be had: their parents stand for them
WantedPages wanted_pages(const Sight& sight, const PageBounds& bounds, const geo::GridFrame& frame, int top,
                         double exaggeration, std::size_t most,
                         const std::function<bool(const Page&)>& damaged);

/// Of the mip level, in the shader too: ground is seen at an angle, its level is that of its steepest
/// direction, and blurs the other.
inline constexpr double kSharper = -0.8;

}  // namespace relevo::viewer
