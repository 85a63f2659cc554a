#include "lod/cache_sizes.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::lod {

namespace {

constexpr double kNear = 1.2;
constexpr double kFar = 2;
constexpr double kFastMibS = 200;
constexpr double kSlowMibS = 100;

}  // namespace

std::size_t texels_in(std::size_t wanted, std::optional<std::uint64_t> graphics_free) {
    if (!graphics_free) return wanted;
    return std::min(wanted, std::max(kLeastTexels, static_cast<std::size_t>(*graphics_free / 2)));
}

CacheSizes cache_sizes(const MachineFigures& machine, std::optional<std::uint64_t> memory_bytes) {
    CacheSizes sizes;
    sizes.memory_bytes =
        memory_bytes.value_or(std::clamp(machine.memory_available / 4, kLeastMemory, kMostMemory));
    sizes.mesh_bytes = static_cast<std::size_t>(sizes.memory_bytes / 4);
    sizes.texel_bytes = texels_in(std::min(sizes.mesh_bytes, kMostTexels), machine.graphics_free);

    sizes.threads = static_cast<int>(std::clamp(machine.cores / 2, 2U, 4U));
    sizes.swap_factor = kNear;
    if (const auto& rate = machine.read_mib_s) {
        if (*rate < kSlowMibS) sizes.threads = 2;
        sizes.swap_factor = std::clamp(kNear * std::sqrt(kFastMibS / std::max(*rate, 1e-3)), kNear, kFar);
    }
    return sizes;
}

}  // namespace relevo::lod
