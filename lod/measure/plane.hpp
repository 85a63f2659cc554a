#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "lod/measure/area.hpp"
#include "lod/measure/height_sampler.hpp"

namespace relevo::lod {

/// The surface H = const that an area's volumes are above and below, as its user names it.
struct Plane {
    enum class Kind {
        lowest,  ///< the lowest H in the polygon: nothing is below
        border,  ///< the lowest H on its sides: a pond's overflow, the foot of a heap
        mean,    ///< its mean H: as much is above as below
        given,
    };
    Kind kind = Kind::lowest;
    double H_m = 0;  ///< of a given one
    friend bool operator==(const Plane&, const Plane&) = default;
};

/// "lowest", "border", "mean" or metres. Reading what to_string says gives the same, to the last bit.
std::string to_string(const Plane& plane);
Result<Plane> parse_plane(std::string_view text);

/// measure_area with such a plane; with `mean` it is gone through twice. Fails as that does, and with
/// ErrorKind::input for `border` where no height is known on the sides.
Result<AreaMeasurement> measure_area(HeightSampler& sampler, std::span<const geo::LatLon> polygon,
                                     const Plane& plane, const std::function<bool(double)>& progress = {});

}  // namespace relevo::lod
