#include "lod/cache_sizes.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace relevo::test {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

lod::MachineFigures machine(std::uint64_t available_mib, unsigned cores = 8) {
    return {
        .memory_total = 2 * available_mib * kMiB, .memory_available = available_mib * kMiB, .cores = cores};
}

TEST(CacheSizes, MemoryIsAQuarterOfWhatIsAvailableWithinBounds) {
    for (const auto& [available, taken] : {std::pair{100, 256}, std::pair{1024, 256}, std::pair{4096, 1024},
                                           std::pair{12000, 3000}, std::pair{500000, 4096}}) {
        const auto sizes = lod::cache_sizes(machine(static_cast<std::uint64_t>(available)));
        EXPECT_EQ(sizes.memory_bytes, static_cast<std::uint64_t>(taken) * kMiB) << available;
        EXPECT_EQ(sizes.mesh_bytes, sizes.memory_bytes / 4);
        EXPECT_LE(sizes.texel_bytes, sizes.memory_bytes / 4);
        EXPECT_LE(sizes.texel_bytes, lod::kMostTexels);
    }
}

TEST(CacheSizes, WhatTheUserSaysCounts) {
    const auto sizes = lod::cache_sizes(machine(100), 64 * kMiB);
    EXPECT_EQ(sizes.memory_bytes, 64 * kMiB);
    EXPECT_EQ(sizes.mesh_bytes, 16 * kMiB);
    EXPECT_EQ(sizes.texel_bytes, 16 * kMiB);
    EXPECT_EQ(lod::cache_sizes(machine(100), 65536 * kMiB).memory_bytes, 65536 * kMiB);
}

TEST(CacheSizes, TexelsTakeHalfOfAFreeGraphicsCard) {
    auto found = machine(32768);
    EXPECT_EQ(lod::cache_sizes(found).texel_bytes, 192 * kMiB);
    found.graphics_free = 8192 * kMiB;
    EXPECT_EQ(lod::cache_sizes(found).texel_bytes, 192 * kMiB);
    found.graphics_free = 128 * kMiB;
    EXPECT_EQ(lod::cache_sizes(found).texel_bytes, 64 * kMiB);
    found.graphics_free = 0;
    EXPECT_EQ(lod::cache_sizes(found).texel_bytes, lod::kLeastTexels);
}

TEST(CacheSizes, ASlowDiskIsReadFartherAheadByFewerThreads) {
    auto found = machine(8192, 16);
    EXPECT_EQ(lod::cache_sizes(found).swap_factor, 1.2);
    EXPECT_EQ(lod::cache_sizes(found).threads, 4);
    double last = 1.2;
    for (const double rate : {5000.0, 200.0, 150.0, 100.0, 80.0, 20.0, 0.0}) {
        found.read_mib_s = rate;
        const auto sizes = lod::cache_sizes(found);
        EXPECT_GE(sizes.swap_factor, last) << rate;
        EXPECT_LE(sizes.swap_factor, 2) << rate;
        EXPECT_EQ(sizes.threads, rate < 100 ? 2 : 4) << rate;
        last = sizes.swap_factor;
    }
    EXPECT_EQ(last, 2);
    found.read_mib_s = 100;
    EXPECT_NEAR(lod::cache_sizes(found).swap_factor, 1.2 * std::sqrt(2.0), 1e-12);
    EXPECT_EQ(lod::cache_sizes(machine(8192, 1)).threads, 2);
}

}  // namespace
}  // namespace relevo::test
