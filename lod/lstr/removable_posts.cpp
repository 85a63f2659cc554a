#include "lod/lstr/removable_posts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lod/machine_clones.hpp"

namespace relevo::lod {

namespace {

constexpr int kStride = 64;  // posts at a time: a word of bits

/// 1 where a post may go. Without a branch, so that some posts are judged at once; comparisons with NaN are
/// false.
template <RemovalTest test>
inline std::uint8_t may_go(const float* north, const float* here, const float* south, float margin) {
    const float E = here[0];
    if constexpr (test == RemovalTest::pairs) {
        const auto near = [&](float a, float b) {
            return static_cast<std::uint8_t>(std::abs(0.5F * (a + b) - E) <= margin);
        };
        return static_cast<std::uint8_t>(near(north[-1], south[1]) & near(north[0], south[0]) &
                                         near(north[1], south[-1]) & near(here[1], here[-1]));
    } else {
        const float sum = ((north[-1] + south[1]) + (north[0] + south[0])) +
                          ((north[1] + south[-1]) + (here[-1] + here[1]));
        return static_cast<std::uint8_t>(std::abs(0.125F * sum - E) <= margin);
    }
}

template <RemovalTest test>
inline void judge(const float* north, const float* here, const float* south, int count, float margin,
                  std::uint8_t* found) {
    for (int i = 0; i < count; ++i) found[i] = may_go<test>(north + i, here + i, south + i, margin);
}

[[RELEVO_CLONES("avx2", "default")]] void judge_pairs(const float* north, const float* here,
                                                      const float* south, int count, float margin,
                                                      std::uint8_t* found) {
    judge<RemovalTest::pairs>(north, here, south, count, margin, found);
}

[[RELEVO_CLONES("avx2", "default")]] void judge_mean(const float* north, const float* here,
                                                     const float* south, int count, float margin,
                                                     std::uint8_t* found) {
    judge<RemovalTest::mean>(north, here, south, count, margin, found);
}

/// Of bytes of 0 or 1 their lowest bits, eight at a time: the product brings them side by side into the top
/// byte.
std::uint64_t packed(const std::uint8_t* found) {
    std::uint64_t bits = 0;
    for (int i = 0; i < kStride / 8; ++i) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, found + 8 * i, 8);
        bits |= ((eight * 0x0102040810204080U) >> 56) << (8 * i);
    }
    return bits;
}

}  // namespace

PostSet removable_posts(const Raster<float>& heights, float margin_m, RemovalTest test) {
    const int columns = heights.columns();
    PostSet removable(columns, heights.rows());
    const auto judge_row = test == RemovalTest::pairs ? judge_pairs : judge_mean;
    tbb::parallel_for(tbb::blocked_range<int>(1, std::max(heights.rows() - 1, 1)),
                      [&](const tbb::blocked_range<int>& rows) {
                          std::vector<std::uint8_t> found(static_cast<std::size_t>(columns) + kStride);
                          for (int row = rows.begin(); row < rows.end(); ++row) {
                              if (columns < 3) continue;
                              judge_row(heights.row(row - 1) + 1, heights.row(row) + 1,
                                        heights.row(row + 1) + 1, columns - 2, margin_m, found.data() + 1);
                              found[static_cast<std::size_t>(columns) - 1] = 0;
                              for (int column = 0; column < columns; column += kStride)
                                  removable.set_word({column, row}, packed(found.data() + column));
                          }
                      });
    return removable;
}

float margin_of_range(const Raster<float>& heights, double percent) {
    float lowest = INFINITY;
    float highest = -INFINITY;
    for (const float H : heights.samples()) {
        if (std::isnan(H)) continue;
        lowest = std::min(lowest, H);
        highest = std::max(highest, H);
    }
    return lowest <= highest ? static_cast<float>(0.01 * percent * static_cast<double>(highest - lowest)) : 0;
}

}  // namespace relevo::lod
