#include "viewer/ground/ground_materials.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

constexpr std::array kAll{Material::grass, Material::rock, Material::gravel, Material::snow, Material::grain};
using Tile = std::vector<MaterialTexel>;

const MaterialTexel& texel(const Tile& tile, int column, int row) {
    const auto wrapped = [](int at) {
        return static_cast<std::size_t>((at + kMaterialSide) % kMaterialSide);
    };
    return tile[wrapped(row) * kMaterialSide + wrapped(column)];
}

/// Mean difference of a channel between a column, or a row, and the next one.
double step(const Tile& tile, std::size_t channel, int at, bool rows) {
    double sum = 0;
    for (int i = 0; i < kMaterialSide; ++i) {
        const MaterialTexel& a = rows ? texel(tile, i, at) : texel(tile, at, i);
        const MaterialTexel& b = rows ? texel(tile, i, at + 1) : texel(tile, at + 1, i);
        sum += std::abs(int{a[channel]} - int{b[channel]});
    }
    return sum / kMaterialSide;
}

// Across the tile's border texels differ as much as inside it.
TEST(GroundMaterials, TilesRepeatWithoutASeam) {
    for (const Material material : kAll) {
        const Tile tile = material_tile(material);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            for (const bool rows : {false, true}) {
                double largest = 0;
                for (int at = 0; at + 1 < kMaterialSide; ++at)
                    largest = std::max(largest, step(tile, channel, at, rows));
                EXPECT_LE(step(tile, channel, kMaterialSide - 1, rows), largest)
                    << to_string(material) << " channel " << channel;
            }
        }
    }
}

TEST(GroundMaterials, ASeedGivesTheSameBytesAndAnotherOneOthers) {
    for (const Material material : kAll) {
        EXPECT_EQ(material_tile(material, 7), material_tile(material, 7));
        EXPECT_NE(material_tile(material, 7), material_tile(material, 8));
    }
}

TEST(GroundMaterials, MeansAreTheMiddle) {
    for (const Material material : kAll) {
        std::array<double, 4> sums{};
        const Tile tile = material_tile(material);
        for (const MaterialTexel& at : tile) {
            for (std::size_t channel = 0; channel < 4; ++channel) sums[channel] += at[channel];
        }
        for (const double sum : sums)
            EXPECT_NEAR(sum / static_cast<double>(tile.size()) / 255, 0.5, 0.01) << to_string(material);
    }
}

TEST(GroundMaterials, Differ) {
    for (const Material a : kAll) {
        for (const Material b : kAll) {
            if (a >= b) continue;
            const Tile one = material_tile(a);
            const Tile other = material_tile(b);
            double difference = 0;
            for (std::size_t i = 0; i < one.size(); ++i)
                difference += std::abs(int{one[i][0]} - int{other[i][0]});
            EXPECT_GT(difference / static_cast<double>(one.size()), 20)
                << to_string(a) << " " << to_string(b);
        }
    }
}

// What rises to the right is told to rise to the right: the sum of slopes along a row comes back to where it
// began.
TEST(GroundMaterials, SlopesAreThoseOfASurfaceThatCloses) {
    for (const Material material : {Material::grass, Material::grain}) {
        const Tile tile = material_tile(material);
        for (int row = 0; row < kMaterialSide; row += 16) {
            double right = 0;
            double up = 0;
            for (int i = 0; i < kMaterialSide; ++i) {
                right += texel(tile, i, row)[2] - 127.5;
                up += texel(tile, row, i)[3] - 127.5;
            }
            EXPECT_NEAR(right / kMaterialSide, 0, 3) << to_string(material) << " row " << row;
            EXPECT_NEAR(up / kMaterialSide, 0, 3) << to_string(material) << " column " << row;
        }
    }
}

}  // namespace
}  // namespace relevo::viewer
