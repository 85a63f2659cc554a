#pragma once

#include <array>
#include <cstdint>

namespace relevo::viewer {

/// Noise on the unit square that repeats in both directions. Equal seeds give equal noise on every machine.
class PeriodicNoise {
  public:
    explicit PeriodicNoise(std::uint64_t seed) : seed_(seed) {}

    /// Gradient noise (K. Perlin, SIGGRAPH 2002) with so many cells a side: -1 to 1, mean 0.
    double gradient(double x, double y, int cells) const;

    /// Its octaves, each of twice as many cells and `falling` the amplitude of the one before.
    double octaves(double x, double y, int cells, int count, double falling = 0.5) const;

    struct Cell {
        double nearest;  ///< distance to the nearest point in cells, 0 to about 1
        double second;   ///< to the one after it
        double number;   ///< the nearest point's own, 0 to 1
    };
    /// S. Worley's cellular noise (SIGGRAPH 1996): a point in each of so many cells a side.
    Cell cellular(double x, double y, int cells) const;

  private:
    /// Two numbers of a lattice cell, 0 to 1; the same a period later.
    std::array<double, 2> at(int column, int row, int cells) const;

    std::uint64_t seed_;
};

}  // namespace relevo::viewer
