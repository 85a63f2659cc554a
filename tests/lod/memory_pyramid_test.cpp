#include "lod/pyramid/memory_pyramid.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

using Normal = GroundPosts::Normal;

MemoryPyramid pyramid_of(const geo::GridFrame& frame, const Raster<float>& heights,
                         const Raster<std::uint8_t>& sea = {}) {
    return {frame, heights, build_metrics(frame, {}, heights), sea};
}

/// Posts of every block of a level that holds data, by their place in the level's grid.
template <class Visit>
void for_each_block_of(const Pyramid& pyramid, int level, Visit visit) {
    const int size = Pyramid::kBlockCells << level;
    for (int row = 0; row * size < pyramid.frame().rows; ++row) {
        for (int column = 0; column * size < pyramid.frame().columns; ++column)
            visit(PyramidBlock{level, column, row});
    }
}

TEST(MemoryPyramid, LevelsAreSamplesOfTheGrid) {
    const auto frame = test::geographic_frame(700, 300);
    const auto heights = test::make_heights(frame, [](int column, int row) {
        return column > 500 && row > 200 ? std::numeric_limits<double>::quiet_NaN()
                                         : test::mountains(column, row);
    });
    Raster<std::uint8_t> sea(700, 300);
    for (int column = 0; column < 90; ++column) sea.at(column, 8) = 255;
    const MetricRasters metrics = build_metrics(frame, {}, heights);
    const Raster<float> mesh = mesh_heights(frame, heights);
    const MemoryPyramid pyramid(frame, heights, metrics, sea);
    ASSERT_EQ(frame.levels(), 10);
    ASSERT_EQ(pyramid.top(), 2);
    int blocks = 0;
    for (int level = 0; level <= 2; ++level) {
        for_each_block_of(pyramid, level, [&](const PyramidBlock& block) {
            const auto bounded = pyramid.read_vertices(block, ErrorMetric::bounded);
            const auto incremental = pyramid.read_vertices(block, ErrorMetric::incremental);
            const auto ground = pyramid.read_ground(block);
            ASSERT_TRUE(bounded && incremental && ground);
            ASSERT_EQ(bounded->heights.columns(), 257);
            ASSERT_EQ(bounded->heights.rows(), 257);
            for (int row = 0; row <= 256; ++row) {
                for (int column = 0; column <= 256; ++column) {
                    const int x = (256 * block.column + column) << level;
                    const int y = (256 * block.row + row) << level;
                    ASSERT_EQ(bounded->heights.at(column, row), mesh.at(x, y));
                    ASSERT_EQ(bounded->error.at(column, row), metrics.bounded.at(x, y));
                    ASSERT_EQ(incremental->error.at(column, row), metrics.incremental.at(x, y));
                    ASSERT_EQ(bounded->radius.at(column, row), metrics.radius.at(x, y));
                    const float H = x < 700 && y < 300 ? heights.at(x, y) : test::kVoid;
                    const float read = ground->heights.at(column, row);
                    ASSERT_TRUE(read == H || (std::isnan(read) && std::isnan(H)));
                    ASSERT_EQ(ground->is_sea.at(column, row), y == 8 && x < 90 ? 255 : 0);
                    if (std::isnan(H)) {
                        ASSERT_EQ(ground->normals.at(column, row), Normal{});
                    }
                }
            }
            ++blocks;
        });
    }
    EXPECT_EQ(blocks, 6 + 2 + 1);
}

TEST(MemoryPyramid, ASmallGridIsOneBlock) {
    const auto frame = test::geographic_frame(3, 2);
    const auto pyramid = pyramid_of(frame, test::make_heights(frame, test::mountains));
    EXPECT_EQ(pyramid.top(), 0);
    const auto posts = pyramid.read_vertices({0, 0, 0}, ErrorMetric::bounded);
    ASSERT_TRUE(posts);
    EXPECT_EQ(posts->heights.columns(), 3);
    EXPECT_EQ(posts->heights.rows(), 3);
}

double normal_at(const GroundPosts& posts, int column, int row, std::size_t axis) {
    return posts.normals.at(column, row)[axis] / 32767.0;
}

// A plane that rises by known metres a post, with voids in it: differences of both sides and of one alike see
// the plane, whatever is missing.
TEST(GroundNormals, OfAPlaneAreThePlanes) {
    for (const auto& frame : {test::geographic_frame(40, 30, 60),
                              test::polar_frame(geo::FrameKind::ups_north, 40, 30, 90, 5e5, -2e5)}) {
        const auto heights = test::make_heights(frame, [](int column, int row) {
            const bool is_void = column % 7 == 2 && row % 5 == 2;
            return is_void ? std::numeric_limits<double>::quiet_NaN() : 1000 + 9.0 * column - 4.0 * row;
        });
        const auto pyramid = pyramid_of(frame, heights);
        const auto ground = pyramid.read_ground({0, 0, 0});
        ASSERT_TRUE(ground);
        for (int row = 0; row < 30; ++row) {
            for (int column = 0; column < 40; ++column) {
                if (std::isnan(heights.at(column, row))) continue;
                const auto spacing = frame.spacing({static_cast<double>(column), static_cast<double>(row)});
                const double along = 9.0 / spacing.column_m;
                const double up = 4.0 / spacing.row_m;
                const double length = std::sqrt(1 + along * along + up * up);
                ASSERT_NEAR(normal_at(*ground, column, row, 0), -along / length, 1.0 / 32767);
                ASSERT_NEAR(normal_at(*ground, column, row, 1), -up / length, 1.0 / 32767);
            }
        }
    }
}

TEST(GroundNormals, GoOnAcrossTheSeamOfAGridRoundTheEarth) {
    geo::GridFrame frame{geo::FrameKind::geographic, -180, 90, 1, 1, 361, 181};
    ASSERT_TRUE(frame.closes());
    // Steep on both sides of the antimeridian, level beside it: one-sided differences would see 0.
    const auto heights = test::make_heights(frame, [](int column, int) {
        return column == 1 ? 90000.0 : column == 359 ? -90000.0 : 0.0;
    });
    const auto pyramid = pyramid_of(frame, heights);
    const auto west = pyramid.read_ground({0, 0, 0});
    const auto east = pyramid.read_ground({0, 1, 0});
    ASSERT_TRUE(west && east);
    EXPECT_LT(normal_at(*west, 0, 90, 0), -0.5);
    EXPECT_EQ(west->normals.at(0, 90), east->normals.at(360 - 256, 90));
    EXPECT_EQ(west->normals.at(0, 0), Normal{}) << "a pole's row is one point";
}

TEST(GroundNormals, OfCoarserLevelsAreMeansOfWhatIsValidAround) {
    const auto frame = test::geographic_frame(513, 400);
    const auto heights = test::make_heights(frame, [](int column, int row) {
        return test::noise(column, row) < 0.3 ? std::numeric_limits<double>::quiet_NaN()
                                              : test::mountains(column, row);
    });
    const auto pyramid = pyramid_of(frame, heights);
    ASSERT_EQ(pyramid.top(), 1);
    const auto coarse = pyramid.read_ground({1, 0, 0});
    ASSERT_TRUE(coarse);
    Raster<Normal> fine(513, 400);
    for_each_block_of(pyramid, 0, [&](const PyramidBlock& block) {
        const auto ground = pyramid.read_ground(block);
        ASSERT_TRUE(ground);
        for (int row = 0; row <= 256 && 256 * block.row + row < 400; ++row) {
            for (int column = 0; column <= 256 && 256 * block.column + column < 513; ++column)
                fine.at(256 * block.column + column, 256 * block.row + row) = ground->normals.at(column, row);
        }
    });
    int compared = 0;
    for (int row = 0; row < 200; ++row) {
        for (int column = 0; column < 257; ++column) {
            if (std::isnan(heights.at(2 * column, 2 * row))) {
                ASSERT_EQ(coarse->normals.at(column, row), Normal{});
                continue;
            }
            for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
                double sum = 0;
                double weights = 0;
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        const int x = 2 * column + dx;
                        const int y = 2 * row + dy;
                        if (x < 0 || y < 0 || x >= 513 || y >= 400 || std::isnan(heights.at(x, y))) continue;
                        const double weight = (dx == 0 ? 0.5 : 0.25) * (dy == 0 ? 0.5 : 0.25);
                        sum += weight * fine.at(x, y)[axis];
                        weights += weight;
                    }
                }
                ASSERT_NEAR(coarse->normals.at(column, row)[axis], sum / weights, 0.5 + 1e-9);
            }
            ++compared;
        }
    }
    EXPECT_GT(compared, 30000);
}

}  // namespace
}  // namespace relevo::lod
