#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "lod/soar/metrics.hpp"
#include "lod/terrain.hpp"

namespace relevo::test {

inline constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

/// A geographic frame whose north-west post is at (north, west).
inline geo::GridFrame geographic_frame(int columns, int rows, double north = 36, double west = 138,
                                       double step = 1.0 / 3600) {
    return {geo::FrameKind::geographic, west, north, step, step, columns, rows};
}

/// A polar frame whose middle is at (x, y) metres from the pole in UPS.
inline geo::GridFrame polar_frame(geo::FrameKind kind, int columns, int rows, double step, double x = 0,
                                  double y = 0) {
    return {kind,
            geo::kUpsFalseOrigin + x - 0.5 * (columns - 1) * step,
            geo::kUpsFalseOrigin + y + 0.5 * (rows - 1) * step,
            step,
            step,
            columns,
            rows};
}

/// Heights of a frame from a function of column and row.
template <class Height>
lod::Raster<float> make_heights(const geo::GridFrame& frame, Height height) {
    lod::Raster<float> heights(frame.columns, frame.rows);
    for (int row = 0; row < frame.rows; ++row) {
        for (int column = 0; column < frame.columns; ++column) {
            heights.at(column, row) = static_cast<float>(height(column, row));
        }
    }
    return heights;
}

inline lod::Terrain make_terrain(const geo::GridFrame& frame, const lod::Raster<float>& heights,
                                 lod::ErrorMetric metric = lod::ErrorMetric::bounded,
                                 const lod::UndulationGrid& undulations = {},
                                 const lod::Raster<std::uint8_t>& sea = {}) {
    return lod::Terrain(frame, undulations, heights, lod::build_metrics(frame, undulations, heights), metric,
                        sea);
}

/// The same number for the same place on every machine, in [0, 1).
inline double noise(int column, int row) {
    auto x = static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 |
             static_cast<std::uint32_t>(row);
    x = (x ^ (x >> 31)) * 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9u;
    return static_cast<double>((x ^ (x >> 32)) >> 11) * 0x1p-53;
}

/// Rough mountains: waves of every length down to two posts.
inline double mountains(int column, int row) {
    double H = 1500;
    double amplitude = 600;
    for (double length = 100; length > 2; length /= 2.1, amplitude /= 2) {
        H += amplitude * std::sin(column / length + 1.7 * std::sin(row / length)) *
             std::cos(row / (0.8 * length));
    }
    return H + 3 * noise(column, row);
}

/// The ellipsoidal height of the ground at a post plus some metres: a place for an eye.
inline geo::Geodetic above(const lod::Terrain& terrain, double column, double row, double metres) {
    const geo::LatLon place = terrain.frame().lat_lon({column, row});
    const int c = static_cast<int>(std::lround(column));
    const int r = static_cast<int>(std::lround(row));
    const double ground =
        static_cast<double>(lod::TruePosts::Reader(terrain.posts()).H(c, r)) + terrain.undulations().at(c, r);
    return {place.lat, place.lon, {ground + metres}};
}

}  // namespace relevo::test
