#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/reference/crs.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// What a band and the command line say about heights.
struct VerticalClues {
    std::string unit;  ///< of the band, as GDAL gives it; may be empty
    double scale = 1;  ///< of the band
    double offset = 0;
    std::optional<VerticalCrs> crs;

    std::optional<double>
        height_scale;          ///< --height-scale: metres per unit of value, in place of the units above
    double height_offset = 0;  ///< --height-offset: metres, added last
    std::optional<lod::VerticalDatum> datum;  ///< --vertical
};

/// How a raster's values become heights H in metres, and what they are above.
struct HeightRule {
    double scale = 1;
    double offset = 0;
    lod::VerticalReference reference;
    std::vector<std::string> notes;  ///< what was assumed or converted, for people

    /// Values are heights as they are: nothing is computed, so that they stay bit for bit.
    bool identity() const { return scale == 1 && offset == 0; }
    double operator()(double value) const { return value * scale + offset; }
};

/// Fails where the clues contradict each other or the unit is not one of length.
Result<HeightRule> height_rule(const VerticalClues& clues);

/// A unit of length in metres: "m", "metre", "ft", "US survey foot", ... Nothing for what is not one.
std::optional<double> length_unit(const std::string& name);

}  // namespace relevo::ingest
