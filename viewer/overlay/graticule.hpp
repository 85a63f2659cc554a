#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "geo/frame.hpp"
#include "geo/utm.hpp"

namespace relevo::viewer {

/// Lines of equal longitude and latitude, or of equal easting and northing of UTM.
struct Graticule {
    bool is_utm = false;
    /// Of UTM: each zone's own lines within it. Else, around a pole, those of `zone` all over the picture.
    bool every_zone = false;
    geo::UtmZone zone = {};  ///< of UTM: the one below the eye
    glm::dvec2 interval{
        1};  ///< between lines: longitude and latitude in degrees, or easting and northing in metres

    /// The zone whose lines are drawn at a place.
    geo::UtmZone zone_at(geo::LatLon place) const { return every_zone ? geo::utm_zone(place) : zone; }

    /// Longitude and latitude, or easting and northing, in intervals: lines are where one is whole.
    glm::dvec2 lines(geo::LatLon place) const;

    /// What is written on a line: "45\u00b030' N", "105\u00b029'15\" W", "13N 456000 E".
    /// \param axis  0: of a longitude or an easting, 1: of a latitude or a northing
    /// \param in    the zone of UTM that the line is in
    std::string text(int axis, double line, geo::UtmZone in = {}) const;
};

/// One that suits a view: lines 160 to 480 pixels apart, where a pixel is so large, below the eye. Degrees
/// come as 30, 10, 5, 2, 1, 30', 10', 5', 2', 1', 30", 10" ... and at last tenths of seconds.
Graticule suitable_graticule(bool utm, geo::LatLon eye, double pixel_m);

/// A graticule as the ground's shader draws it: in grid coordinates from a post near the eye, so that a line
/// is where it is to a float's precision of its distance from there, and not of its place in a grid of 2^15
/// posts.
///
/// u = (column - anchor) / reach, v likewise with rows. An area has lines of both kinds as polynomials of
/// degree 4 in either direction of (u, v) less its centre over its reach: term i + 5 k is of u^i v^k, its x
/// of the first kind of lines, its y of the second. They go through the exact values at 5 x 5 places. Of
/// longitudes and latitudes in a geographic grid they are exact; of UTM where the reach is 50 km they are off
/// by at most 0.02 mm within 50 km of the centre, 2 mm within 100 km and 0.25 m within 250 km (measured
/// against GeographicLib, to 64 degrees of latitude): a millionth of the way there.
struct GraticuleTerms {
    static constexpr int kTerms = 5;
    static constexpr int kMostAreas = 16;

    /// Where one set of lines holds. All but UTM's in a geographic grid have one without bounds.
    struct Area {
        geo::UtmZone zone;
        /// West, north, east, south, in u and v; those that are borders of zones, which are drawn.
        std::array<double, 4> bounds{-1e6, -1e6, 1e6, 1e6};
        std::array<bool, 4> is_border{};
        glm::dvec2 centre{0};  ///< in u and v; the place nearest to the anchor
        glm::dvec2 reach{1};   ///< likewise
        std::array<glm::dvec2, kTerms * kTerms> terms;
    };
    glm::dvec2 anchor{0};     ///< its column and row
    glm::dvec2 reach{1};      ///< columns and rows
    std::vector<Area> areas;  ///< the nearest first
};

/// Around the post nearest to a place. The constant terms are taken to less than an interval from 0.
/// \param reach_m  how far polynomials have to be exact: more, for eyes that see far, is less near by
/// \param seen_m   how far there is something to be seen: of farther zones, and of those that have none of
/// the data, there are no lines
GraticuleTerms graticule_terms(const Graticule& graticule, const geo::GridFrame& grid, geo::LatLon around,
                               double reach_m = 50e3, double seen_m = 250e3);

/// What the shader makes of it; nothing outside of all areas.
std::optional<glm::dvec2> lines(const GraticuleTerms& terms, geo::GridPosition place);

}  // namespace relevo::viewer
