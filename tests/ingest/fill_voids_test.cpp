#include "ingest/posts/fill_voids.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/ingest/classifying.hpp"

namespace relevo::ingest {
namespace {

using lod::PostClass;
using test::Heights;
using test::Marks;

const float kNone = std::nanf("");

struct Filled {
    Heights heights;
    Marks marks;
    std::uint64_t count = 0;

    std::uint64_t voids() const {
        std::uint64_t posts = 0;
        for (const auto mark : marks.samples()) posts += mark.is_void() ? 1 : 0;
        return posts;
    }
};

Filled filled(const Heights& heights, int width, int side = 4096) {
    Filled result{heights, test::marks_of(heights)};
    const Marks before = result.marks;
    for (const Window block : test::blocks_of(heights.columns(), heights.rows(), side)) {
        const auto halo = test::halo_block(heights.columns(), heights.rows(), block, fill_halo(width));
        Heights part = test::part(heights, halo.all);
        Marks marks = test::part(before, halo.all);
        const auto done = fill_voids(part, marks, halo.inside, width);
        if (!done) {
            ADD_FAILURE() << done.error().message;
            continue;
        }
        result.count += *done;
        test::put(part, halo.inside, block.column, block.row, result.heights);
        test::put(marks, halo.inside, block.column, block.row, result.marks);
    }
    return result;
}

Heights plane(int columns, int rows) {
    Heights heights(columns, rows);
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c)
            heights.at(c, r) = 100.0F + 2.0F * static_cast<float>(c) - static_cast<float>(r);
    }
    return heights;
}

void cut(Heights& heights, Window hole) {
    for (int r = hole.row; r < hole.row + hole.rows; ++r) {
        for (int c = hole.column; c < hole.column + hole.columns; ++c) heights.at(c, r) = kNone;
    }
}

TEST(FillVoids, FillsUpToItsWidthAndNothingWider) {
    for (int width = 1; width <= 8; ++width) {
        for (int side = 1; side <= 10; ++side) {
            Heights heights = plane(40, 40);
            cut(heights, {12, 15, side, side});
            const Filled result = filled(heights, width);
            const auto hole = static_cast<std::uint64_t>(side * side);
            EXPECT_EQ(result.count, side <= width ? hole : 0) << width << " " << side;
            EXPECT_EQ(result.voids(), side <= width ? 0 : hole) << width << " " << side;
        }
    }
}

TEST(FillVoids, MarksWhatItFilledAndKeepsTheRest) {
    Heights heights = plane(30, 30);
    cut(heights, {10, 10, 3, 2});
    const Filled result = filled(heights, 3);
    for (int r = 0; r < 30; ++r) {
        for (int c = 0; c < 30; ++c) {
            const bool hole = std::isnan(heights.at(c, r));
            const auto mark = result.marks.at(c, r);
            EXPECT_EQ(mark.filled(), hole);
            EXPECT_EQ(mark.post_class(), PostClass::land);
            if (hole) {
                EXPECT_NEAR(result.heights.at(c, r), plane(30, 30).at(c, r), 3.0);
            } else {
                EXPECT_EQ(result.heights.at(c, r), heights.at(c, r));
            }
        }
    }
}

TEST(FillVoids, ALongCrackIsNarrow) {
    Heights heights = plane(200, 40);
    cut(heights, {20, 17, 150, 1});
    cut(heights, {60, 5, 1, 30});
    const Filled result = filled(heights, 1);
    EXPECT_EQ(result.voids(), 0U);
}

TEST(FillVoids, AVoidOpenToTheBorderStays) {
    for (const Window hole :
         {Window{0, 10, 1, 1}, {29, 10, 1, 1}, {10, 0, 2, 1}, {10, 29, 1, 1}, {0, 0, 2, 2}, {28, 12, 2, 3}}) {
        Heights heights = plane(30, 30);
        cut(heights, hole);
        const Filled result = filled(heights, 4);
        EXPECT_EQ(result.count, 0U) << hole.column << " " << hole.row;
    }
}

TEST(FillVoids, ARoundVoidStaysWhole) {
    for (const double radius : {3.0, 4.5, 7.0, 12.0}) {
        Heights heights = plane(60, 60);
        for (int r = 0; r < 60; ++r) {
            for (int c = 0; c < 60; ++c) {
                if (std::hypot(c - 30, r - 30) <= radius) heights.at(c, r) = kNone;
            }
        }
        EXPECT_EQ(filled(heights, 3).count, 0U) << radius;
    }
}

TEST(FillVoids, StaysWithinItsSurroundings) {
    std::mt19937 random{7};
    std::uniform_real_distribution<float> height{-20, 900};
    Heights heights(80, 80);
    for (float& h : heights.samples()) h = height(random);
    for (int i = 0; i < 40; ++i)
        cut(heights, {static_cast<int>(random() % 75), static_cast<int>(random() % 75), 3, 2});
    const Filled result = filled(heights, 5);
    EXPECT_GT(result.count, 100U);
    for (std::size_t i = 0; i < result.marks.samples().size(); ++i) {
        if (!result.marks.samples()[i].filled()) continue;
        EXPECT_GE(result.heights.samples()[i], -20);
        EXPECT_LE(result.heights.samples()[i], 900);
    }
}

/// Bit for bit the same, whichever way the data is cut into blocks.
TEST(FillVoids, DoesNotDependOnTheBlocks) {
    std::uint64_t all = 0;
    for (std::uint32_t seed = 1; seed <= 25; ++seed) {
        std::mt19937 random{seed};
        std::normal_distribution<float> noise{0, 40};
        Heights heights = plane(130, 110);
        for (float& h : heights.samples()) h += noise(random);
        const int holes = 5 + static_cast<int>(random() % 60);
        for (int i = 0; i < holes; ++i) {
            const int columns = 1 + static_cast<int>(random() % 12);
            const int rows = 1 + static_cast<int>(random() % 12);
            cut(heights, {static_cast<int>(random() % static_cast<unsigned>(131 - columns)),
                          static_cast<int>(random() % static_cast<unsigned>(111 - rows)), columns, rows});
        }
        for (const int width : {1, 3, 8}) {
            const Filled whole = filled(heights, width);
            all += whole.count;
            for (const int side : {9, 32, 77}) {
                const Filled blocks = filled(heights, width, side);
                ASSERT_EQ(blocks.marks.samples(), whole.marks.samples())
                    << "seed " << seed << " side " << side;
                for (std::size_t i = 0; i < heights.samples().size(); ++i) {
                    if (whole.marks.samples()[i].is_void()) continue;
                    ASSERT_EQ(blocks.heights.samples()[i], whole.heights.samples()[i])
                        << "seed " << seed << " side " << side << " width " << width;
                }
            }
        }
    }
    EXPECT_GT(all, 5000U);
}

/// The rule as it is written, by trying every square and every step.
TEST(FillVoids, FillsWhatItsRuleSays) {
    for (std::uint32_t seed = 1; seed <= 15; ++seed) {
        std::mt19937 random{seed};
        Heights heights = plane(40, 35);
        for (int i = 0; i < 14; ++i) {
            const int columns = 1 + static_cast<int>(random() % 8);
            const int rows = 1 + static_cast<int>(random() % 8);
            cut(heights, {static_cast<int>(random() % static_cast<unsigned>(41 - columns)),
                          static_cast<int>(random() % static_cast<unsigned>(36 - rows)), columns, rows});
        }
        const auto is_void = [&](int c, int r) {
            return c < 0 || r < 0 || c >= 40 || r >= 35 || std::isnan(heights.at(c, r));
        };
        for (const int width : {1, 2, 4}) {
            constexpr int kAround = 12;
            test::Heights wide(40 + 2 * kAround, 35 + 2 * kAround, 0);
            for (int r = -kAround; r + width < 35 + kAround; ++r) {
                for (int c = -kAround; c + width < 40 + kAround; ++c) {
                    bool all = true;
                    for (int y = 0; y <= width; ++y) {
                        for (int x = 0; x <= width; ++x) all = all && is_void(c + x, r + y);
                    }
                    for (int y = 0; all && y <= width; ++y) {
                        for (int x = 0; x <= width; ++x) wide.at(c + x + kAround, r + y + kAround) = 1;
                    }
                }
            }
            for (int step = 0; step < width; ++step) {
                const test::Heights before = wide;
                for (int r = 0; r < 35; ++r) {
                    for (int c = 0; c < 40; ++c) {
                        if (!is_void(c, r)) continue;
                        for (int y = -1; y <= 1; ++y) {
                            for (int x = -1; x <= 1; ++x) {
                                if (before.at(c + x + kAround, r + y + kAround) == 1)
                                    wide.at(c + kAround, r + kAround) = 1;
                            }
                        }
                    }
                }
            }
            const Filled result = filled(heights, width);
            for (int r = 0; r < 35; ++r) {
                for (int c = 0; c < 40; ++c) {
                    const bool expected = is_void(c, r) && wide.at(c + kAround, r + kAround) == 0;
                    ASSERT_EQ(result.marks.at(c, r).filled(), expected)
                        << "seed " << seed << " width " << width << " at " << c << "," << r;
                }
            }
        }
    }
}

}  // namespace
}  // namespace relevo::ingest
