#include "geo/angle.hpp"

#include <cassert>
#include <cmath>

namespace relevo::geo {

// std::remainder is exact, so a whole turn more or less never costs a digit.

Degrees wrapped_180(Degrees angle) {
    assert(std::isfinite(angle.value));
    const double wrapped = std::remainder(angle.value, 360.0);
    return Degrees{wrapped == 180 ? -180 : wrapped};
}

Degrees wrapped_360(Degrees angle) {
    assert(std::isfinite(angle.value));
    const double wrapped = std::remainder(angle.value, 360.0);
    if (wrapped >= 0) return Degrees{wrapped + 0.0};  // + 0.0: no negative zero
    const double turned = wrapped + 360;
    return Degrees{turned < 360 ? turned : 0.0};  // a tiny negative angle rounds to a whole turn
}

}  // namespace relevo::geo
