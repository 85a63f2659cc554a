#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "lod/machine_figures.hpp"

namespace relevo::lod {

/// How much of a scene is kept in memory, and how it is read.
struct CacheSizes {
    std::uint64_t memory_bytes = 0;  ///< for all below, blocks being read, and the program
    std::size_t mesh_bytes = 0;      ///< of tiles, or of the quadtree's nodes
    std::size_t texel_bytes = 0;     ///< of the ground's pages
    int threads = 0;                 ///< that read
    double swap_factor = 0;          ///< of the quadtree's nodes (SelectionOptions)
};

inline constexpr std::uint64_t kLeastMemory = std::uint64_t{256} << 20;
inline constexpr std::uint64_t kMostMemory = std::uint64_t{4} << 30;  ///< that is taken unasked
inline constexpr std::size_t kMostTexels = std::size_t{192} << 20;
inline constexpr std::size_t kLeastTexels = std::size_t{16} << 20;

/// What fits a machine.
///
/// - Memory is a quarter of what is available, 256 MiB to 4 GiB, unless `memory_bytes` says it. A quarter of
///   it is for meshes, at most a quarter for texels.
/// - Of graphics memory that is its own, texels take half of what is free.
/// - Threads that read also unpack: half of the cores, 2 to 4; from a disk below 100 MiB/s two, as more would
///   wait for the same disk.
/// - The swap sphere reaches 1.2 times as far as nodes are drawn from where 200 MiB/s or more are read or
///   nothing is known. Slower disks have it grow to twice as far: what is in it, and so how long a flight
///   leaves for reading, goes with its square.
CacheSizes cache_sizes(const MachineFigures& machine, std::optional<std::uint64_t> memory_bytes = {});

/// The part for texels, where graphics memory of its own has so much free (nothing: it has none, or does not
/// tell).
std::size_t texels_in(std::size_t wanted, std::optional<std::uint64_t> graphics_free);

}  // namespace relevo::lod
