#pragma once

#include <cstdint>

#include "geo/frame.hpp"

namespace relevo::ingest {

/// How the memory that an import may take is divided.
struct MemoryBudget {
    std::uint64_t least = 0;        ///< what it takes at the least
    std::uint64_t gdal_cache = 0;   ///< of which GDAL's cache of source blocks
    std::uint64_t posts_cache = 0;  ///< the rest: finished blocks that are wanted again
};

/// \param allowed   bytes in all
/// \param one_read  bytes that one thread takes to read a block from the sources
/// \param threads   that work at once
MemoryBudget divide_memory(std::uint64_t allowed, const geo::GridFrame& frame, std::uint64_t one_read,
                           int threads);

}  // namespace relevo::ingest
