#pragma once

#include <string>
#include <vector>

#include "geo/result.hpp"

namespace relevo::ingest {

/// A raster of sea heights as lod::WaveMap takes it: a square whose side is a power of two.
struct WaveMapPosts {
    int side = 0;
    std::vector<float> heights_m;  ///< row by row from the south, each from the west
    int columns = 0;               ///< of the raster
    int rows = 0;
};

inline constexpr int kMostWaveMapSide = 1024;
inline constexpr int kMostWaveMapRasterSide = 4096;
inline constexpr double kMostWaveMapRange = 100;  ///< metres from lowest to highest

/// Reads the heights of a square of sea that repeats, from any raster of one band that GDAL reads; the band's
/// last row is the south, whatever its georeference says. Heights are as stored with the band's scale,
/// offset and unit, or stretched to `range_m` from the lowest to the highest, where that is above 0. It must
/// be given for integers of 8 or 16 bits without a unit, scale or offset: those are shades of grey.
///
/// Columns and rows that are not a power of two, the same for both, are resampled to the one that is next to
/// the larger of them, 1024 at most: the periodic cubic spline through the posts at the power above, whose
/// pairs are averaged until there are as few as wanted.
Result<WaveMapPosts> read_wave_map(const std::string& file, double range_m);

}  // namespace relevo::ingest
