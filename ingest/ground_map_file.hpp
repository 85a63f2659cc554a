#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"

namespace relevo::ingest {

/// Shares of the natural ground's four materials (grass, rock, gravel, snow) over a scene's grid: parts of
/// 255, row by row from the grid's first. The first texel's outer edge is half a post before the first post,
/// the last one's half a post after the last. They are 255 together where the file has data, less on its
/// border, and 0 where it has none.
struct GroundMapTexels {
    int columns = 0;
    int rows = 0;
    std::vector<std::array<std::uint8_t, 4>> shares;
};

inline constexpr int kMostGroundMapSide = 4096;

/// Reads a raster of four bands of bytes, the weights of the materials in this order, in any CRS, and warps
/// it to a scene's grid: a texel a post, or 4096 a side over all of the grid where that has more. Weights are
/// relative to each other: 1 0 0 0 is as much grass as 255 0 0 0. Where all four are 0 or nodata it has no
/// data. Fails with ErrorKind::input where the file is not such a raster, or has no data in the grid.
Result<GroundMapTexels> read_ground_map(const std::string& file, const geo::GridFrame& frame);

}  // namespace relevo::ingest
