#include "ingest/mosaic/longitudes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace relevo::ingest {

double start_after_largest_gap(std::vector<LonReach> reaches, double turn) {
    assert(!reaches.empty());
    for (LonReach& reach : reaches) {
        const double turns = turn * std::floor(reach.west / turn);
        reach = {reach.west - turns, reach.east - turns};
    }
    std::sort(reaches.begin(), reaches.end(),
              [](const LonReach& a, const LonReach& b) { return a.west < b.west; });
    // What reaches beyond the full turn covers the beginning of the next.
    double covered = -turn;
    for (const LonReach& reach : reaches) covered = std::max(covered, reach.east - turn);
    double start = reaches[0].west;
    double largest = -turn;
    for (const LonReach& reach : reaches) {
        if (reach.west - covered > largest) {
            largest = reach.west - covered;
            start = reach.west;
        }
        covered = std::max(covered, reach.east);
    }
    return start;
}

}  // namespace relevo::ingest
