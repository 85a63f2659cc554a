#pragma once

#include <vector>

namespace relevo::geo {

/// A geoid model as it comes from a file: N at the nodes of a grid of latitude and longitude.
struct GeoidNodes {
    /// More is refused: twice EGM2008 on its 2.5' grid. Larger grids are cut to the place first.
    static constexpr long long kMost = 80'000'000;

    double south = 0;  ///< of node (0, 0), degrees
    double west = 0;
    double step_lat = 0;  ///< degrees, > 0
    double step_lon = 0;
    int rows = 0;
    int columns = 0;
    std::vector<double> undulations;  ///< metres, row by row from the south; NaN where the model has none
};

}  // namespace relevo::geo
