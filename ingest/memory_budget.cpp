#include "ingest/memory_budget.hpp"

#include <algorithm>

#include "lod/scene/block_grid.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

// Measured (docs/ingest.md): the program with its libraries, the geoid and PROJ's database.
constexpr std::uint64_t kProgram = 80 * kMiB;
// A metric tile's positions (4 doubles a post), codes and normals, blocks of the pyramid's levels and what
// compressing them takes.
constexpr std::uint64_t kTile = 32 * kMiB;
// A post of the lattice: its height, the mean of its cell, three codes, its normal and class.
constexpr std::uint64_t kLatticePost = 4 + 4 + 6 + 5;

std::uint64_t square(std::uint64_t side) {
    return side * side;
}

}  // namespace

MemoryBudget divide_memory(std::uint64_t allowed, const geo::GridFrame& frame, std::uint64_t one_read,
                           int threads) {
    const auto side = static_cast<std::uint64_t>(frame.padded_side());
    const std::uint64_t lattice = square(side / lod::BlockGrid::kLatticeSpacing + 1) * kLatticePost;
    const std::uint64_t fixed =
        kProgram + lattice + static_cast<std::uint64_t>(threads) * std::max(one_read, kTile);
    // Blocks around those that are worked on: without them each would be decoded nine times.
    constexpr std::uint64_t kBlock =
        std::uint64_t{lod::SceneInfo::kBlockSide} * lod::SceneInfo::kBlockSide * 6;
    const std::uint64_t least_cache = 9 * kBlock * static_cast<std::uint64_t>(threads);

    MemoryBudget budget;
    const std::uint64_t rest = allowed > fixed ? allowed - fixed : 0;
    budget.gdal_cache = std::clamp(rest / 4, 16 * kMiB, 64 * kMiB);
    budget.least = fixed + 16 * kMiB + least_cache;
    budget.posts_cache = rest > budget.gdal_cache + least_cache ? rest - budget.gdal_cache : least_cache;
    return budget;
}

}  // namespace relevo::ingest
