#pragma once

#include <unordered_map>

#include <glm/vec3.hpp>

#include "geo/post_positions.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/undulation_grid.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/ground/page.hpp"

namespace relevo::viewer {

/// Where the ground of a page is at most: made when first asked for, as there may be very many pages.
class PageBounds {
  public:
    /// All must outlive the bounds.
    PageBounds(const geo::GridFrame& frame, const geo::PostPositions& positions,
               const lod::UndulationGrid& undulations, const GroundFacts& facts);

    struct Bounds {
        glm::dvec3 centre{0};  ///< ECEF, metres
        double radius_m = 0;
        /// Between neighbouring posts of level 0, the smaller of both directions; where the page has most of
        /// it.
        double spacing_m = 0;
    };

    /// A sphere around the page's data, with heights H from the lowest to the highest of the whole data,
    /// times the exaggeration. \pre the page has data
    Bounds of(const Page& page, double exaggeration) const;

  private:
    /// Of the bare surface H = 0, which is what takes time.
    struct Bare {
        glm::dvec3 centre{0};
        glm::dvec3 up{0};
        double radius_m = 0;
        double spacing_m = 0;
    };
    Bare bare(const Page& page) const;

    const geo::GridFrame& frame_;
    const geo::PostPositions& positions_;
    const lod::UndulationGrid& undulations_;
    double middle_m_;
    double half_range_m_;
    mutable std::unordered_map<Page, Bare, PageHash> known_;
};

}  // namespace relevo::viewer
