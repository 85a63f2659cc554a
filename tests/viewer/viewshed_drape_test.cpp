#include "viewer/ground/viewshed_drape.hpp"

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

/// Seen in stripes, around post (300, 270) of a grid.
std::shared_ptr<const lod::Viewshed> stripes() {
    auto shed = std::make_shared<lod::Viewshed>();
    shed->box = {200, 170, 201, 201};
    shed->posts = lod::Raster<std::uint8_t>(201, 201, lod::Viewshed::none);
    for (int row = 0; row < 201; ++row) {
        for (int column = 0; column < 201; ++column)
            shed->posts.at(column, row) = static_cast<std::uint8_t>((column / 8) % 3);
    }
    return shed;
}

TEST(ViewshedDrape, ATexelIsItsPost) {
    const auto shed = stripes();
    const ViewshedDrape drape(shed);
    for (const Page& page : {Page{0, 0, 0}, Page{0, 1, 0}, Page{0, 0, 1}, Page{0, 1, 1}, Page{0, 5, 5}}) {
        const auto texels = drape.read(page);
        ASSERT_TRUE(texels);
        for (int row = 0; row < kPagePosts; row += 3) {
            for (int column = 0; column < kPagePosts; ++column) {
                const int x = page.column * kPageCells + column - shed->box.column;
                const int y = page.row * kPageCells + row - shed->box.row;
                const auto& texel =
                    (*texels)[static_cast<std::size_t>(row) * kPagePosts + static_cast<std::size_t>(column)];
                if (x < 0 || y < 0 || x > 200 || y > 200) {
                    ASSERT_EQ(texel[3], 0);
                    continue;
                }
                const std::uint8_t seen = shed->posts.at(x, y);
                ASSERT_GT(texel[3], 100);
                ASSERT_LT(texel[3], 200) << "the ground shows through";
                for (std::size_t i = 0; i < 3; ++i) ASSERT_LE(texel[i], texel[3]) << "times alpha";
                ASSERT_EQ(texel[1] > texel[0] + 20, seen == lod::Viewshed::visible) << "green";
                ASSERT_EQ(texel[0] > texel[2] + 60, seen == lod::Viewshed::unknown) << "yellow";
            }
        }
    }
}

TEST(ViewshedDrape, CoarserTexelsAreMeansAroundTheirPosts) {
    const auto shed = stripes();
    const ViewshedDrape drape(shed);
    const auto fine = drape.read({0, 0, 0});
    const auto coarse = drape.read({3, 0, 0});
    ASSERT_TRUE(fine && coarse);
    // The whole of the viewshed has the same alpha and hue at both, to the rounding of sampling its edge.
    double sums[2][4]{};
    for (const Page& page : {Page{0, 0, 0}, Page{0, 1, 0}, Page{0, 0, 1}, Page{0, 1, 1}}) {
        const auto texels = drape.read(page);
        for (int row = 0; row < kPageCells; ++row) {
            for (int column = 0; column < kPageCells; ++column) {
                for (std::size_t i = 0; i < 4; ++i)
                    sums[0][i] += (*texels)[static_cast<std::size_t>(row) * kPagePosts +
                                            static_cast<std::size_t>(column)][i];
            }
        }
    }
    for (const auto& texel : *coarse) {
        for (std::size_t i = 0; i < 4; ++i) sums[1][i] += 64.0 * texel[i];
    }
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(sums[1][i] / sums[0][i], 1, 0.05) << i;
}

}  // namespace
}  // namespace relevo::viewer
