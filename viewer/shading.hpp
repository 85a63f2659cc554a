#pragma once

#include <string_view>

#include "geo/result.hpp"

namespace relevo::viewer {

/// How light makes the ground's shape seen.
///
/// Two are sums over four lights as high as the sun: where it stands, 45 degrees to its right, 45 and 90
/// degrees to its left; each counts by half of a weight that depends on the angle between its azimuth and the
/// slope's aspect. Flat ground is as light as under one of them. R. K. Mark ("Multidirectional,
/// oblique-weighted, shaded-relief image of the Island of Hawaii", USGS Open-File Report 92-422, 1992) takes
/// the square of the sine: slopes are lit from the side. GDAL and QGIS, which refer to him, take that of the
/// cosine: slopes are lit from the front.
enum class Shading {
    sun,               ///< one light: the cosine of the angle to it; as `gdaldem hillshade`
    multidirectional,  ///< by cos^2; with the sun of maps (315, 45) `gdaldem hillshade -multidirectional`
    oblique,           ///< by sin^2: Mark's
    /// 1 - angle to the sun * slope / (pi^2 / 4): steep is dark, and darker away from the sun, and flat
    /// ground white; as `gdaldem hillshade -combined`.
    combined,
};

std::string_view to_string(Shading shading);
Result<Shading> parse_shading(std::string_view text);

}  // namespace relevo::viewer
