#include "ingest/mosaic/lattice.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace relevo::ingest {

std::optional<Window> window_in(const Affine& lattice, const Affine& posts, int columns, int rows) {
    const auto inverse = lattice.inverse();
    assert(inverse);
    const Place first = inverse->at(posts.at({0, 0}));
    const double column = std::round(first.x);
    const double row = std::round(first.y);
    constexpr double kMost = std::numeric_limits<int>::max() / 4;
    if (!(std::abs(column) < kMost && std::abs(row) < kMost)) return {};
    for (const Place corner : {Place{0, 0}, Place{columns - 1.0, 0}, Place{0, rows - 1.0}}) {
        const Place found = inverse->at(posts.at(corner));
        if (!(std::abs(found.x - column - corner.x) <= kLatticeTolerance &&
              std::abs(found.y - row - corner.y) <= kLatticeTolerance))
            return {};
    }
    return Window{static_cast<int>(column), static_cast<int>(row), columns, rows};
}

}  // namespace relevo::ingest
