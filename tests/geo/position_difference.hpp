#pragma once

#include <algorithm>
#include <random>

#include <glm/geometric.hpp>

#include "geo/post_positions.hpp"

namespace relevo::geo {

/// Largest distance of PostPositions from GridFrame::ecef, which takes every post through GeographicLib, over
/// the padded grid.
inline double worst_difference(const GridFrame& frame) {
    const PostPositions posts(frame);
    std::mt19937_64 random(7);
    std::uniform_int_distribution<int> index(0, frame.padded_side() - 1);
    double worst = 0;
    for (const double h : {-11000.0, 0.0, 100.0, 4000.0, 9000.0}) {
        for (int i = 0; i < 20000; ++i) {
            const int column = index(random);
            const int row = index(random);
            const GridPosition place{static_cast<double>(column), static_cast<double>(row)};
            const Ecef exact = frame.ecef(place, EllipsoidalHeight{h});
            worst = std::max(worst, glm::length(posts.at(column, row, h) - exact.m));
        }
    }
    return worst;
}

}  // namespace relevo::geo
