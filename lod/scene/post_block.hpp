#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::lod {

/// How the heights of a scene are stored.
struct HeightCoding {
    HeightType type = HeightType::float32;
    double max_error_m = 0;  ///< 0: as they are; else LERC may change them by at most this
};

/// The bytes of a block's file; empty where all is void. Fails where a height does not fit the type.
Result<std::vector<std::byte>> encode_heights(const Raster<float>& heights, const HeightCoding& coding,
                                              const geo::GridFrame& frame, const BlockGrid::Box& box);

/// Heights H of a block, metres, void = NaN. No bytes: all void. \param name  for the message
Result<Raster<float>> decode_heights(std::span<const std::byte> bytes, HeightType type,
                                     const BlockGrid::Box& box, const std::string& name);

/// Marks as plain as they can be: land of source 0 where there is a height, else void.
Raster<PostMark> plain_marks(const Raster<float>& heights);

/// The bytes of a block's file; empty where the marks are plain.
Result<std::vector<std::byte>> encode_marks(const Raster<PostMark>& marks, const Raster<float>& heights);

/// No bytes: plain ones. Fails where they do not fit the heights (a void has none, all else has one).
Result<Raster<PostMark>> decode_marks(std::span<const std::byte> bytes, const Raster<float>& heights,
                                      const std::string& name);

}  // namespace relevo::lod
