#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lod/ocean/wind_sea.hpp"

namespace relevo::viewer {

/// The sea's slopes at lengths that no mesh carries, in tiles that repeat: two octaves a layer, each layer's
/// waves twice as long as the last one's. A pixel takes the two layers whose texels are about its size: so no
/// layer needs coarser copies.
class Ripples {
  public:
    static constexpr int kLayers = 10;
    static constexpr int kSide = 128;  ///< texels

    explicit Ripples(const lod::Wind& wind);

    /// Of a layer's tile, metres.
    static double tile_m(int layer) { return std::ldexp(1.0, layer); }
    /// The middle of its waves' lengths, metres.
    static double length_m(int layer) { return tile_m(layer) / 16; }

    /// East of a layer is turned by this from the chart's: tiles of different layers do not lie on each
    /// other.
    static double turned(int layer) { return 2.4 * layer; }

    /// Largest slope of a layer.
    double steepest(int layer) const { return steepest_[static_cast<std::size_t>(layer)]; }

    /// Texels of a layer at a time, row by row to the north: slope to the east and to the north over the
    /// steepest, from -1 to 1 as 0 to 255.
    void bake(int layer, double time_s, std::vector<std::uint8_t>& rg) const;

  private:
    struct Wave {
        int east, north;  // waves a tile
        double slope;     // along its way
        double omega;
        double phase;
    };
    std::array<std::vector<Wave>, kLayers> waves_;
    std::array<double, kLayers> steepest_{};
};

}  // namespace relevo::viewer
