#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "lod/error_metric.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// What pictures need of some posts besides their heights.
struct Ground {
    /// Along the row and up the column, of a unit normal, times 32767.
    using Normal = std::array<std::int16_t, 2>;

    Raster<Normal> normals;        ///< 0 at voids
    Raster<std::uint8_t> classes;  ///< PostClass

    Ground() = default;
    Ground(int columns, int rows) : normals(columns, rows), classes(columns, rows) {}
};

/// What refinement needs of some vertices: codes (metric_code.hpp).
struct VertexCodes {
    Raster<std::uint16_t> error;
    Raster<std::uint16_t> radius;
};

// Blocks of the levels of a pyramid, of LevelGrid::kPosts posts a side (docs/scene-format.md). Decoding fails
// with ErrorKind::damaged; `name` is for the message.

/// Heights of meshes, without gaps. Fails where one does not fit the type.
Result<std::vector<std::byte>> encode_level_heights(const Raster<float>& heights, HeightType type);
Result<Raster<float>> decode_level_heights(std::span<const std::byte> bytes, HeightType type,
                                           const std::string& name);

/// Codes and ground of the same posts. Normals keep 8 bits: off by at most 0.004 in the square root.
Result<std::vector<std::byte>> encode_vertices(const MetricRasters& codes, const Ground& ground);
/// One metric of what encode_vertices wrote.
Result<VertexCodes> decode_codes(std::span<const std::byte> bytes, ErrorMetric metric,
                                 const std::string& name);
/// The ground of it.
Result<Ground> decode_ground(std::span<const std::byte> bytes, const std::string& name);

}  // namespace relevo::lod
