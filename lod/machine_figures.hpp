#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace relevo::lod {

/// What a machine has, as far as caches go (cache_sizes.hpp).
struct MachineFigures {
    std::uint64_t memory_total = 0;  ///< bytes that this process may have at most: a container's limit counts
    std::uint64_t memory_available = 0;  ///< of them, without pushing others out
    unsigned cores = 1;
    /// Free memory of a graphics card that has its own and tells.
    std::optional<std::uint64_t> graphics_free = {};
    /// Of the scene's disk; nothing where too little of it had to be read from there.
    std::optional<double> read_mib_s = {};
    /// Of what was read to find that out, the part that was in memory already and counts for nothing.
    double cached_part = 0;
};

/// Memory and cores. Where a file system like Linux's /proc and /sys is mounted elsewhere, `root` says where.
MachineFigures find_memory(const std::filesystem::path& root = "/");

/// Those, and how fast a scene's folder is read: up to 16 MiB of its files, 128 KiB here and there, for 60 ms
/// at most. The system is asked to forget these pieces first; those that it still has in memory (what was
/// just written, and file systems that live there) are not counted. A disk's own cache, or that of a host
/// around a virtual machine, cannot be told from the disk: the rate is then what one gets.
MachineFigures find_machine(const std::filesystem::path& folder);

}  // namespace relevo::lod
