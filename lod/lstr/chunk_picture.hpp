#pragma once

#include <cstdint>
#include <vector>

#include "lod/lstr/chunk_selector.hpp"
#include "lod/lstr/fixed_frame.hpp"

namespace relevo::lod {

/// The nodes that a view shows. Valid until the mesher that gave it is asked for the next.
struct ChunkPicture {
    const std::vector<SelectedChunk>* nodes = nullptr;
    FixedFrame frame;           ///< of their places
    std::uint64_t edition = 0;  ///< of the places, in the whole process: nodes are sent anew with another
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
};

}  // namespace relevo::lod
