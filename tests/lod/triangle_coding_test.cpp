#include "lod/lstr/triangle_coding.hpp"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "lod/lstr/triangle_order.hpp"

namespace relevo::lod {
namespace {

constexpr std::uint32_t kSide = 24;
constexpr std::size_t kVertices = kSide * kSide;

std::vector<IndexTriangle> grid_of_cells() {
    std::vector<IndexTriangle> triangles;
    for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
        for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
            const std::uint32_t v = row * kSide + column;
            triangles.push_back({v, v + kSide, v + 1});
            triangles.push_back({v + 1, v + kSide, v + kSide + 1});
        }
    }
    return triangles;
}

IndexTriangle smallest_first(IndexTriangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

void expect_same(const std::vector<IndexTriangle>& got, const std::vector<IndexTriangle>& wanted) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) ASSERT_EQ(smallest_first(got[i]), smallest_first(wanted[i]));
}

/// Triangles that share nothing, not even an order.
std::vector<IndexTriangle> scattered() {
    std::vector<IndexTriangle> triangles;
    for (std::uint32_t i = 0; i < 200; ++i)
        triangles.push_back({i * 37 % 576, (i * 91 + 5) % 576, (i * 53 + 11) % 576});
    return triangles;
}

TEST(TriangleCoding, GivesBackBothWaysWhatItTook) {
    for (const auto& triangles : {grid_of_cells(),
                                  cache_order(grid_of_cells(), kVertices),
                                  strip_order(grid_of_cells(), kVertices),
                                  scattered(),
                                  {}}) {
        for (const bool strips : {false, true}) {
            NumberWriter numbers;
            strips ? write_strips(triangles, numbers) : write_list(triangles, numbers);
            NumberReader reader(numbers.bytes());
            std::vector<IndexTriangle> back(triangles.size());
            ASSERT_TRUE(strips ? read_strips(reader, kVertices, back) : read_list(reader, kVertices, back));
            EXPECT_TRUE(reader.at_end());
            expect_same(back, triangles);
            NumberWriter again;
            strips ? write_strips(back, again) : write_list(back, again);
            EXPECT_EQ(again.bytes(), numbers.bytes());
        }
    }
}

TEST(TriangleCoding, StripsTakeLittleMoreThanAByteATriangle) {
    const auto triangles = strip_order(grid_of_cells(), kVertices);
    NumberWriter list, strips;
    write_list(triangles, list);
    write_strips(triangles, strips);
    EXPECT_LT(strips.bytes().size(), 2 * triangles.size());
    EXPECT_GE(list.bytes().size(), 3 * triangles.size());
}

TEST(TriangleCoding, NamesNoVertexThatIsNotThere) {
    const auto triangles = cache_order(grid_of_cells(), kVertices);
    for (const bool strips : {false, true}) {
        NumberWriter numbers;
        strips ? write_strips(triangles, numbers) : write_list(triangles, numbers);
        for (std::size_t at = 0; at < numbers.bytes().size(); at += 5) {
            for (const int bit : {1, 16, 64}) {
                auto damaged = numbers.bytes();
                damaged[at] ^= static_cast<std::byte>(bit);
                NumberReader reader(damaged);
                std::vector<IndexTriangle> back(triangles.size());
                if (!(strips ? read_strips(reader, kVertices, back) : read_list(reader, kVertices, back)))
                    continue;
                for (const IndexTriangle& t : back) {
                    for (const std::uint32_t v : t) ASSERT_LT(v, kVertices);
                }
            }
        }
    }
}

TEST(TriangleOrder, DependsOnTheTrianglesAloneAndIsGoodForTheCache) {
    const auto triangles = grid_of_cells();
    auto other = triangles;
    std::reverse(other.begin(), other.end());
    for (IndexTriangle& t : other) std::rotate(t.begin(), t.begin() + 1, t.end());
    for (const auto order : {cache_order, strip_order}) {
        const auto ordered = order(triangles, kVertices);
        EXPECT_EQ(order(other, kVertices), ordered);
        EXPECT_EQ(order(ordered, kVertices), ordered);
    }
    // Vertices worked out, a triangle, by a cache of 16: row by row it is one, at best one half.
    const auto misses = [](const std::vector<IndexTriangle>& list) {
        return meshopt_analyzeVertexCache(list.front().data(), 3 * list.size(), kVertices, 16, 0, 0).acmr;
    };
    EXPECT_LT(misses(cache_order(triangles, kVertices)), 0.75F);
    EXPECT_LT(misses(strip_order(triangles, kVertices)), misses(triangles));
    EXPECT_GT(misses(triangles), 0.95F);
}

}  // namespace
}  // namespace relevo::lod
