#include "lod/lstr/fixed_frame.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relevo::lod {

FixedFrame FixedFrame::of(const Terrain& terrain, double exaggeration) {
    const geo::GridFrame& frame = terrain.frame();
    FixedFrame made;
    made.origin = terrain.position(frame.columns / 2, frame.rows / 2, 0, exaggeration);
    // Padding repeats the last posts. The highest and the deepest of the earth are less than 12 km from zero.
    double radius_m = 0;
    constexpr int kLattice = 16;
    for (int i = 0; i <= kLattice; ++i) {
        for (int j = 0; j <= kLattice; ++j) {
            const int side = (1 << frame.levels());
            const glm::dvec3 at = terrain.position(side / kLattice * i, side / kLattice * j, 0, exaggeration);
            radius_m = std::max(radius_m, glm::distance(at, made.origin));
        }
    }
    radius_m = 1.1 * radius_m + 12e3 * std::max(std::abs(exaggeration), 1.0);
    made.unit_m = std::exp2(std::ceil(std::log2(radius_m)) - 30);
    return made;
}

glm::ivec3 FixedFrame::fixed(const glm::dvec3& ecef) const {
    return glm::ivec3(glm::round((ecef - origin) / unit_m));
}

}  // namespace relevo::lod
