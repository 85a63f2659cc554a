#pragma once

#include <array>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "geo/frame.hpp"
#include "geo/utm.hpp"

namespace relevo::viewer {

/// Lines of equal longitude and latitude, or of equal easting and northing of one UTM zone.
struct Graticule {
    bool is_utm = false;
    geo::UtmZone zone = {};  ///< of UTM
    glm::dvec2 interval{
        1};  ///< between lines: longitude and latitude in degrees, or easting and northing in metres

    /// Longitude and latitude, or easting and northing, in intervals: lines are where one is whole.
    glm::dvec2 lines(geo::LatLon place) const;

    /// What is written on a line: "45\u00b030' N", "105\u00b029'15\" W", "456000 E".
    /// \param axis  0: of a longitude or an easting, 1: of a latitude or a northing
    std::string text(int axis, double line) const;
};

/// One that suits a view: lines 160 to 480 pixels apart, where a pixel is so large, below the eye. Degrees
/// come as 30, 10, 5, 2, 1, 30', 10', 5', 2', 1', 30", 10" ... and at last tenths of seconds. The UTM zone is
/// the one below the eye, all over the picture.
Graticule suitable_graticule(bool utm, geo::LatLon eye, double pixel_m);

/// A graticule as the ground's shader draws it: in grid coordinates from a post near the eye, so that a line
/// is where it is to a float's precision of its distance from there, and not of its place in a grid of 2^15
/// posts.
///
/// Lines of both kinds as polynomials of degree 4 in either direction of u = (column - anchor) / reach and v
/// likewise with rows: term i + 5 k is of u^i v^k, its x of the first kind of lines, its y of the second.
/// They go through the exact values at 5 x 5 places, 25 km apart. Of longitudes and latitudes in a geographic
/// grid they are exact; of UTM they are off by at most 0.02 mm within 50 km of the anchor, 2 mm within 100 km
/// and 0.25 m within 250 km (measured against GeographicLib, to 64 degrees of latitude): a millionth of the
/// way there.
struct GraticuleTerms {
    static constexpr int kTerms = 5;
    glm::dvec2 anchor{0};  ///< its column and row
    glm::dvec2 reach{1};   ///< columns and rows
    std::array<glm::dvec2, kTerms * kTerms> terms;
};

/// Around the post nearest to a place. The constant terms are taken to less than an interval from 0.
GraticuleTerms graticule_terms(const Graticule& graticule, const geo::GridFrame& grid, geo::LatLon around);

/// What the shader makes of it.
glm::dvec2 lines(const GraticuleTerms& terms, geo::GridPosition place);

}  // namespace relevo::viewer
