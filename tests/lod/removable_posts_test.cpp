#include "lod/lstr/removable_posts.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

/// As the reference writes them down (figures 42 and 45).
bool may_go(const Raster<float>& heights, int column, int row, float margin, RemovalTest test) {
    if (column == 0 || row == 0 || column + 1 == heights.columns() || row + 1 == heights.rows()) return false;
    const auto H = [&](int x, int y) { return heights.at(column + x, row + y); };
    const float E = H(0, 0);
    const auto near = [&](float a, float b) { return std::abs(0.5F * (a + b) - E) <= margin; };
    if (test == RemovalTest::pairs)
        return near(H(-1, -1), H(1, 1)) && near(H(0, -1), H(0, 1)) && near(H(1, -1), H(-1, 1)) &&
               near(H(1, 0), H(-1, 0));
    const float sum =
        ((H(-1, -1) + H(1, 1)) + (H(0, -1) + H(0, 1))) + ((H(1, -1) + H(-1, 1)) + (H(-1, 0) + H(1, 0)));
    return std::abs(0.125F * sum - E) <= margin;
}

TEST(RemovablePosts, AreThoseOfAPlainLoop) {
    for (const int columns : {1, 2, 3, 4, 63, 64, 65, 66, 67, 128, 200}) {
        for (const int rows : {1, 2, 3, 40}) {
            Raster<float> heights(columns, rows);
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    heights.at(column, row) = static_cast<float>(10 * test::noise(column, row));
                    if (test::noise(row, column) > 0.97) heights.at(column, row) = test::kVoid;
                }
            }
            for (const RemovalTest test : {RemovalTest::pairs, RemovalTest::mean}) {
                const PostSet found = removable_posts(heights, 3, test);
                for (int row = 0; row < rows; ++row) {
                    for (int column = 0; column < columns; ++column) {
                        ASSERT_EQ(found.contains({column, row}), may_go(heights, column, row, 3, test))
                            << columns << " x " << rows << ": " << column << " " << row;
                    }
                }
            }
        }
    }
}

TEST(RemovablePosts, TakeAMarginOfTheRange) {
    // The reference's example: 3 to 53 m, five per cent.
    Raster<float> heights(2, 2, 3);
    heights.at(1, 1) = 53;
    heights.at(0, 1) = test::kVoid;
    EXPECT_FLOAT_EQ(margin_of_range(heights, 5), 2.5F);
    EXPECT_EQ(margin_of_range(Raster<float>(2, 2, test::kVoid), 5), 0);
}

}  // namespace
}  // namespace relevo::lod
