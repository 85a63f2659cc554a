#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/peers/flat_path.hpp"

namespace relevo::peers {

/// A square of heights, metres, from the north-west corner, rows to the east.
struct Heights {
    int posts = 0;  ///< a side
    std::vector<float> samples;

    double spacing_m() const { return kSideM / (posts - 1); }
    float at(int column, int row) const {
        return samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(posts) +
                       static_cast<std::size_t>(column)];
    }
};

/// Reads a file of little-endian floats without a header; empty where it cannot be read or is no square.
Heights read_heights(const std::string& path);

struct PixelErrors {
    double max_px = 0;
    double p99_px = 0;
    double rms_px = 0;
    std::uint64_t pixels = 0;
};

PixelErrors figures_of(std::vector<double>& errors);

/// What lod/oracle measures of a pixel, of a picture of the flat world: the distance on the screen between
/// the pixel and where the true surface at the same place of the map appears. The true surface is that of the
/// cells' triangles; which diagonal cuts a cell is the engine's choice, so that the better of both counts.
/// Places off the map are left out.
/// \param depth  along the view direction, metres, for each pixel from the upper left; infinite: nothing was drawn
PixelErrors measure(const Heights& heights, const Place& eye, int width, int height, const std::vector<double>& depth);

}  // namespace relevo::peers
