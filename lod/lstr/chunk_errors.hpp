#pragma once

namespace relevo::lod {

/// How far levels of the quadtree may be off the ground: level 1 by first_m, each coarser one by twice as
/// much. The coarser one is drawn from twice as far, so that on the screen all are off by the same.
struct ChunkErrors {
    double first_m = 0;

    double of_level(int level) const {
        return level < 1 ? 0 : first_m * static_cast<double>(1 << (level - 1));
    }
    /// Of sides: the rest is for what lies between them.
    double of_side(int level) const { return 0.5 * of_level(level); }

    /// For leaves whose posts are so far apart.
    static ChunkErrors for_spacing(double spacing_m) {
        // At 720 rows and 60 degrees a pixel of it is seen from some 95 posts away: as far as nodes are wide,
        // so that neither errors nor sizes make ranges (chunk_mesher.hpp) larger than they need be.
        constexpr double kPart = 0.15;
        return {kPart * spacing_m};
    }
};

}  // namespace relevo::lod
