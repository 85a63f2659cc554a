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

    /// Of pages that may be smaller than a cell, by heights of some of the posts, 2^apart posts apart: the
    /// range of those around a page, and as much again above and below. Not certain to hold all of its
    /// ground, but near it: for what may be somewhat coarse where it does not. In the sphere of all heights
    /// of a range of mountains one would be, for kilometres, as near as can be to every page. \param finer
    /// pages are of a grid with 2^finer cells where the frame's has one
    PageBounds(const geo::GridFrame& frame, const geo::PostPositions& positions,
               const lod::UndulationGrid& undulations, const GroundFacts& facts, int finer,
               lod::Raster<float> some, int apart);

    struct Bounds {
        glm::dvec3 centre{0};  ///< ECEF, metres
        double radius_m = 0;
        /// Between neighbouring posts of the pages' level 0, the smaller of both directions; where the page
        /// has most of it.
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
        double middle_m = 0;  // of its heights
        double half_range_m = 0;
    };
    void set_heights(Bare& made, int west, int north, int east, int south) const;
    Bare bare(const Page& page) const;

    const geo::GridFrame& frame_;
    const geo::PostPositions& positions_;
    const lod::UndulationGrid& undulations_;
    double middle_m_;
    double half_range_m_;
    int finer_ = 0;
    lod::Raster<float> some_;  // empty: nothing is known of a page
    int apart_ = 0;
    mutable std::unordered_map<Page, Bare, PageHash> known_;
};

}  // namespace relevo::viewer
