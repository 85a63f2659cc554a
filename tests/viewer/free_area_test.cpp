#include "viewer/ui/free_area.hpp"

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

TEST(Covered, ALabelThatAPanelCoversTouchesIt) {
    Covered covered;
    EXPECT_FALSE(covered.touches({0, 0, 100, 100}));
    covered.add({500, 40, 800, 540});
    EXPECT_TRUE(covered.touches({480, 100, 520, 120})) << "by a part";
    EXPECT_TRUE(covered.touches({600, 100, 620, 120}));
    EXPECT_FALSE(covered.touches({400, 100, 500, 120})) << "beside it";
    EXPECT_FALSE(covered.touches({600, 540, 700, 560})) << "below it";
}

TEST(Covered, ALegendIsAsHighAsPanelsLeaveRoomFor) {
    Covered covered;
    const Box legend{8, 350, 105, 550};
    EXPECT_EQ(covered.height_free(legend), 200);
    covered.add({7, 40, 340, 190});
    EXPECT_EQ(covered.height_free(legend), 200) << "above it";
    covered.add({7, 40, 340, 430});
    EXPECT_EQ(covered.height_free(legend), 120);
    covered.add({0, 0, 800, 600});
    EXPECT_EQ(covered.height_free(legend), 0);
}

}  // namespace
}  // namespace relevo::viewer
