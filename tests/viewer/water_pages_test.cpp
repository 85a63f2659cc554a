#include "viewer/ocean/water_pages.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

/// A page's posts: sea east of a column.
std::vector<PageTexels::Shore> sea_from(int column) {
    std::vector<PageTexels::Shore> posts(std::size_t{kPagePosts} * kPagePosts);
    for (int row = 0; row < kPagePosts; ++row) {
        for (int at = column; at < kPagePosts; ++at)
            posts[static_cast<std::size_t>(row * kPagePosts + at)] = {255, 0};
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

TEST(PageSea, TellsOfItsPosts) {
    const PageSea sea(sea_from(70));
    EXPECT_TRUE(sea.all().sea && sea.all().land);
    const auto told = [&](int west, int east) {
        const PageSea::Content content = sea.in(west, 3, east, 5);
        return std::pair(content.sea, content.land);
    };
    EXPECT_EQ(told(0, 69), std::pair(false, true));
    EXPECT_EQ(told(69, 69), std::pair(false, true));
    EXPECT_EQ(told(70, 70), std::pair(true, false));
    EXPECT_EQ(told(69, 70), std::pair(true, true));
    EXPECT_EQ(told(63, 64), std::pair(false, true));
    EXPECT_EQ(told(70, 256), std::pair(true, false));
    EXPECT_EQ(told(256, 256), std::pair(true, false));
    EXPECT_EQ(told(0, 256), std::pair(true, true));
    EXPECT_TRUE(PageSea().all().land);
    EXPECT_FALSE(PageSea().all().sea);
}

TEST(WaterPages, TellWhatThePagesOfAPictureTell) {
    const PageSea coarse(sea_from(100));  // of every 2nd post
    const PageSea fine(sea_from(210));    // of the western half
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

TEST(WaterPages, FinerPagesStandForTheirQuarterAlone) {
    // Its siblings are not there: elsewhere the coarse page is asked, but not where the finer one is.
    const PageSea coarse(sea_from(0));
    const PageSea fine(sea_from(210));
    WaterPages water(grid(513), 1);
    water.fill({{{1, 0, 0}, &coarse}, {{0, 0, 0}, &fine}});
    EXPECT_FALSE(water.in({0, 0, 205, 250}).sea);
    EXPECT_TRUE(water.in({0, 0, 205, 257}).sea);
}

TEST(WaterPages, PagesWithoutDataAreNotMissed) {
    // Of the four finer pages the first alone has data.
    const PageSea coarse(sea_from(0));
    const PageSea fine(sea_from(kPagePosts));
    WaterPages water(grid(257), 1);
    water.fill({{{1, 0, 0}, &coarse}, {{0, 0, 0}, &fine}});
    EXPECT_FALSE(water.in({0, 0, 256, 256}).sea);
}

}  // namespace
}  // namespace relevo::viewer
