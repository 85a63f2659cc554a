#pragma once

#include <algorithm>
#include <array>
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
    double oracle_max_px = 0;  ///< of lod/oracle, at posts too, hidden ones as well; of Relevo's meshes alone
};

PixelErrors figures_of(std::vector<double>& errors);

/// Heights of the true surface at a place of the grid, its cells cut by either diagonal.
/// \param H  height of the post at a column and a row
template <class HeightOfPost>
std::array<double, 2> surfaces_at(HeightOfPost H, int columns, int rows, double x, double y) {
    const int column = std::min(static_cast<int>(x), columns - 2);
    const int row = std::min(static_cast<int>(y), rows - 2);
    const double u = x - column;
    const double v = y - row;
    const double nw = H(column, row);
    const double ne = H(column + 1, row);
    const double sw = H(column, row + 1);
    const double se = H(column + 1, row + 1);
    return {u > v ? nw + u * (ne - nw) + v * (se - ne) : nw + v * (sw - nw) + u * (se - sw),
            u + v < 1 ? nw + u * (ne - nw) + v * (sw - nw) : se + (1 - u) * (sw - se) + (1 - v) * (ne - se)};
}

/// What lod/oracle measures of a pixel, of a picture of the flat world: the distance on the screen between
/// the pixel and where the true surface at the same place of the map appears. The true surface is that of the
/// cells' triangles; which diagonal cuts a cell is the engine's choice, so that the better of both counts.
/// Places off the map are left out.
/// \param depth  along the view direction, metres, for each pixel from the upper left; infinite: nothing was
/// drawn
PixelErrors measure(const Heights& heights, const Place& eye, int width, int height,
                    const std::vector<double>& depth);

}  // namespace relevo::peers
