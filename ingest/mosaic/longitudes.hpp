#pragma once

#include <vector>

namespace relevo::ingest {

/// Longitudes that a source covers, in any turn; east >= west.
struct LonReach {
    double west = 0;
    double east = 0;
};

/// The longitude in [0, turn) from which on eastwards all of them follow without a jump: the end of the
/// largest gap that they leave around the earth. \param turn  360 for degrees \pre reaches is not empty
double start_after_largest_gap(std::vector<LonReach> reaches, double turn);

}  // namespace relevo::ingest
