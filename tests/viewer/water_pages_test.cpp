#include "viewer/ocean/water_pages.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

/// A page's posts: sea east of a column.
std::vector<std::uint8_t> sea_from(int column) {
    std::vector<std::uint8_t> posts(std::size_t{kPagePosts} * kPagePosts);
    for (int row = 0; row < kPagePosts; ++row) {
        for (int at = column; at < kPagePosts; ++at)
            posts[static_cast<std::size_t>(row * kPagePosts + at)] = 255;
    }
    return posts;
}

geo::GridFrame grid(int posts) {
    return {.kind = geo::FrameKind::geographic,
            .west = 0,
            .north = 10,
            .step_x = 0.01,
            .step_y = 0.01,
            .columns = posts,
            .rows = posts};
}

TEST(PageSea, KnowsItsParts) {
    const PageSea sea = page_sea(sea_from(10));
    EXPECT_TRUE(sea.all.sea && sea.all.land);
    EXPECT_FALSE(sea.at(1, 0).sea);  // columns 4 to 8
    EXPECT_TRUE(sea.at(1, 0).land);
    EXPECT_TRUE(sea.at(2, 63).sea && sea.at(2, 63).land);  // 8 to 12
    EXPECT_TRUE(sea.at(3, 5).sea);
    EXPECT_FALSE(sea.at(3, 5).land);
    EXPECT_TRUE(page_sea({}).all.land);
    EXPECT_FALSE(page_sea({}).all.sea);
}

TEST(WaterPages, TellWhatThePagesOfAPictureTell) {
    const PageSea coarse = page_sea(sea_from(100));  // of every 2nd post
    const PageSea fine = page_sea(sea_from(210));    // of the western half
    WaterPages water(grid(513), 1);
    water.fill({{{1, 0, 0}, &coarse}});
    EXPECT_FALSE(water.in({0, 0, 190, 512}).sea);
    EXPECT_TRUE(water.in({0, 0, 205, 512}).sea);
    EXPECT_TRUE(water.in({0, 0, 205, 512}).land);
    EXPECT_FALSE(water.in({300, 0, 512, 512}).land);

    // In the north-west the finer page is asked, elsewhere still the coarse one.
    water.fill({{{1, 0, 0}, &coarse}, {{0, 0, 0}, &fine}});
    EXPECT_TRUE(water.in({0, 0, 205, 256}).land);
    EXPECT_TRUE(water.in({212, 0, 250, 250}).sea);
    EXPECT_TRUE(water.in({150, 300, 205, 400}).sea);
}

TEST(WaterPages, PagesWithoutDataAreNotMissed) {
    // Of the four finer pages the first alone has data.
    const PageSea coarse = page_sea(sea_from(0));
    const PageSea fine = page_sea(std::vector<std::uint8_t>(std::size_t{kPagePosts} * kPagePosts));
    WaterPages water(grid(257), 1);
    water.fill({{{1, 0, 0}, &coarse}, {{0, 0, 0}, &fine}});
    EXPECT_FALSE(water.in({0, 0, 256, 256}).sea);
}

}  // namespace
}  // namespace relevo::viewer
