#include "viewer/overlay/overlay_list.hpp"

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

using Kind = Overlay::Kind;

TEST(OverlayList, ImageryIsPutUnderVectorsAndTheseUnderLines) {
    Overlays list = *parse_overlays("contours:auto:1,graticule:utm:1");
    put_in_place(list, {.kind = Kind::imagery, .file = 0});
    put_in_place(list, {.kind = Kind::vectors, .file = 2});
    put_in_place(list, {.kind = Kind::imagery, .file = 1});
    put_in_place(list, {.kind = Kind::imagery, .opacity = 0.5, .file = 1});  // it is there
    EXPECT_EQ(to_string(list), "imagery:0:1,imagery:1:1,vectors:2:1,contours:auto:1,graticule:utm:1");
}

TEST(OverlayList, AFullListTakesNoMore) {
    Overlays list;
    for (int i = 0; i < 12; ++i) put_in_place(list, {.kind = Kind::imagery, .file = i});
    EXPECT_EQ(list.size(), kMostOverlays);
}

TEST(OverlayList, MovesAsFarAsThereArePlaces) {
    Overlays list = *parse_overlays("imagery:0:1,vectors:1:1,contours:20:1");
    EXPECT_EQ(move_overlay(list, 0, 1), 1u);
    EXPECT_EQ(to_string(list), "vectors:1:1,imagery:0:1,contours:20:1");
    EXPECT_EQ(move_overlay(list, 2, 7), 2u);
    EXPECT_EQ(move_overlay(list, 2, -7), 0u);
    EXPECT_EQ(to_string(list), "contours:20:1,vectors:1:1,imagery:0:1");
    EXPECT_EQ(move_overlay(list, 5, 1), 5u) << "there is none";
}

TEST(OverlayList, RaisingGoesRound) {
    Overlays list = *parse_overlays("imagery:0:1,vectors:1:1,contours:20:1");
    std::size_t chosen = 0;
    chosen = raise_overlay(list, chosen);
    chosen = raise_overlay(list, chosen);
    EXPECT_EQ(to_string(list), "vectors:1:1,contours:20:1,imagery:0:1");
    chosen = raise_overlay(list, chosen);
    EXPECT_EQ(to_string(list), "imagery:0:1,vectors:1:1,contours:20:1");
    EXPECT_EQ(chosen, 0u);
    Overlays none;
    EXPECT_EQ(raise_overlay(none, 0), 0u);
}

TEST(OverlayList, AFileThatGoesRenumbersTheOthers) {
    Overlays list = *parse_overlays("imagery:0:1,imagery:2:0.5,vectors:1:1,contours:20:1");
    forget_file(list, 1);
    EXPECT_EQ(to_string(list), "imagery:0:1,imagery:1:0.5,contours:20:1");
    EXPECT_EQ(index_of_file(list, 1), 1u);
    EXPECT_EQ(index_of_file(list, 7), list.size());
}

}  // namespace
}  // namespace relevo::viewer
