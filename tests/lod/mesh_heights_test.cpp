#include "lod/mesh_heights.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

/// Mountains with narrow and wide voids; data ends at an odd column and an even row.
Raster<float> with_voids(const geo::GridFrame& frame) {
    return test::make_heights(frame, [](int column, int row) {
        const bool wide = column > 30 && column < 61 && row > 10 && row < 33;
        const bool narrow = test::noise(column, row) < 0.2;
        return wide || narrow ? std::numeric_limits<double>::quiet_NaN() : test::mountains(column, row);
    });
}

TEST(MeshHeights, OddPostsWithoutAHeightLieOnTheEdgeThatTheySplit) {
    const auto frame = test::geographic_frame(102, 75);
    const Raster<float> heights = with_voids(frame);
    const Raster<float> mesh = mesh_heights(frame, heights);
    int voids = 0;
    int padding = 0;
    for (int row = 0; row < frame.padded_side(); ++row) {
        for (int column = 0; column < frame.padded_side(); ++column) {
            const bool inside = column < frame.columns && row < frame.rows;
            const float H = mesh.at(column, row);
            ASSERT_FALSE(std::isnan(H));
            if (inside && !std::isnan(heights.at(column, row))) {
                ASSERT_EQ(H, heights.at(column, row));
                continue;
            }
            if (column % 2 == 0 && row % 2 == 0) continue;
            // The diagonals of the finest squares run through posts whose columns and rows are even, and
            // halves of which add up to an even number.
            float mean = 0;
            if (row % 2 == 0) {
                mean = (mesh.at(column - 1, row) + mesh.at(column + 1, row)) / 2;
            } else if (column % 2 == 0) {
                mean = (mesh.at(column, row - 1) + mesh.at(column, row + 1)) / 2;
            } else if ((column / 2 + row / 2) % 2 == 0) {
                mean = (mesh.at(column - 1, row - 1) + mesh.at(column + 1, row + 1)) / 2;
            } else {
                mean = (mesh.at(column + 1, row - 1) + mesh.at(column - 1, row + 1)) / 2;
            }
            ASSERT_EQ(H, mean) << column << ' ' << row;
            ++(inside ? voids : padding);
        }
    }
    EXPECT_GT(voids, 1000);
    EXPECT_GT(padding, 3000);
}

TEST(MeshHeights, AreTheSameInEveryBox) {
    const auto frame = test::geographic_frame(102, 75);
    const Raster<float> heights = with_voids(frame);
    const Raster<float> mesh = mesh_heights(frame, heights);
    MeshHeights fill(frame);
    fill.add(0, 0, heights);
    fill.finish();
    const int last = frame.padded_side() - 1;
    for (const BlockGrid::Box& box : {BlockGrid::Box{4, 6, 21, 31}, BlockGrid::Box{29, 11, 90, 80},
                                      BlockGrid::Box{100, 0, 29, 20}, BlockGrid::Box{110, 90, 19, 39}}) {
        const Raster<float> part = fill.filled(box, part_of(heights, box));
        for (int row = 0; row < box.rows; ++row) {
            for (int column = 0; column < box.columns; ++column) {
                const int x = box.column + column;
                const int y = box.row + row;
                const bool outermost =
                    column == 0 || row == 0 || column + 1 == box.columns || row + 1 == box.rows;
                const bool promised = (x % 2 == 0 || x == last) && (y % 2 == 0 || y == last);
                if (outermost && !promised) continue;
                ASSERT_EQ(part.at(column, row), mesh.at(x, y)) << x << ' ' << y;
            }
        }
    }
}

TEST(MeshHeights, EvenFillsAreWholeWhereTheDataIs) {
    const auto frame = test::geographic_frame(102, 75);
    Raster<float> heights = with_voids(frame);
    const auto count_parts = [&] {
        const Raster<float> mesh = mesh_heights(frame, heights);
        int parts = 0;
        for (int row = 0; row <= 128; row += 2) {
            for (int column = 0; column <= 128; column += 2)
                parts += mesh.at(column, row) != std::round(mesh.at(column, row));
        }
        return parts;
    };
    EXPECT_GT(count_parts(), 1000);
    for (float& H : heights.samples()) H = std::round(H);
    EXPECT_EQ(count_parts(), 0);
}

}  // namespace
}  // namespace relevo::lod
