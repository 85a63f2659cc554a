#include "viewer/ground/cover_block.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::viewer {
namespace {

/// Where a place is in a tile, as the shaders compute it, but in double.
std::array<double, 2> in_tile(const CoverBlock& block, const CoverBlock::Tile& tile, double column,
                              double row) {
    const double x = (column - static_cast<double>(block.anchor.x)) * static_cast<double>(block.anchor.z);
    const double y = (static_cast<double>(block.anchor.y) - row) * static_cast<double>(block.anchor.w);
    const auto [u, v, c, s] = std::array<double, 4>{tile.x, tile.y, tile.z, tile.w};
    return {u + c * x + s * y, v + c * y - s * x};
}

double apart(double a, double b) {
    return std::abs(std::remainder(a - b, 1.0));
}

// The eye goes on to the next post, and with it the anchor: tiles stay where they are.
TEST(CoverBlock, TilesStayOnTheGroundAsTheAnchorMoves) {
    const unsigned seed = 5;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(0, 32768);
    for (const geo::GridFrame& grid :
         {test::geographic_frame(32769, 32769, 45, 7), test::geographic_frame(32769, 32769, -20, 140, 1e-5),
          test::polar_frame(geo::FrameKind::ups_north, 32769, 32769, 30)}) {
        for (int trial = 0; trial < 200; ++trial) {
            const geo::GridPosition at{anywhere(random), anywhere(random)};
            const CoverBlock here = cover_block(grid, grid.lat_lon(at));
            const CoverBlock there = cover_block(grid, grid.lat_lon({at.column + 0.8, at.row - 1.3}));
            // Millimetres: of a post's width in metres as a float, a post away from the anchor.
            const auto expect_same = [&](const CoverBlock::Tile& a, const CoverBlock::Tile& b,
                                         double tile_m) {
                const auto one = in_tile(here, a, at.column, at.row);
                const auto other = in_tile(there, b, at.column, at.row);
                EXPECT_LT(apart(one[0], other[0]) * tile_m, 1e-5 + 1e-6 * tile_m) << "seed " << seed;
                EXPECT_LT(apart(one[1], other[1]) * tile_m, 1e-5 + 1e-6 * tile_m) << "seed " << seed;
            };
            for (std::size_t rung = 0; rung < CoverBlock::kRungs; ++rung)
                expect_same(here.rungs[rung], there.rungs[rung], CoverBlock::tile_m(static_cast<int>(rung)));
            expect_same(here.grain, there.grain, CoverBlock::kGrainM);
            expect_same(here.macro, there.macro, CoverBlock::kMacroM);
        }
    }
}

TEST(CoverBlock, SlopesOfTheMaterialsEndWhereThoseOfTheDataBegin) {
    const geo::GridFrame grid = test::geographic_frame(100, 100, 45, 7);  // 22 x 31 m
    const CoverBlock block = cover_block(grid, grid.lat_lon({50, 50}));
    EXPECT_EQ(block.bumps[0].x, 1);
    EXPECT_EQ(block.bumps[1].x, 1);
    EXPECT_EQ(block.bumps[4].x, 0);
    for (std::size_t rung = 1; rung < CoverBlock::kRungs; ++rung)
        EXPECT_LE(block.bumps[rung].x, block.bumps[rung - 1].x);
}

}  // namespace
}  // namespace relevo::viewer
