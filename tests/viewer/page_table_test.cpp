#include "viewer/ground/page_table.hpp"

#include <map>
#include <random>

#include <gtest/gtest.h>

#include "viewer/ground/page_slots.hpp"

namespace relevo::test {
namespace {

using viewer::Page;
using viewer::PageSlots;
using viewer::PageTable;

TEST(PageTable, NamesTheFinestThatIsThereAndItsParent) {
    constexpr unsigned kSeed = 3;
    std::mt19937 random(kSeed);
    constexpr int kTop = 4;
    PageTable table(kTop);
    EXPECT_EQ(table.entries().size(), 341u);
    for (int round = 0; round < 50; ++round) {
        // Any pages, some without their parents.
        std::map<Page, int> there;
        std::vector<PageTable::Resident> residents;
        const int promille = 100 + static_cast<int>(random() % 900);
        for (int level = kTop; level >= 0; --level) {
            for (int row = 0; row < 1 << (kTop - level); ++row) {
                for (int column = 0; column < 1 << (kTop - level); ++column) {
                    if (level != kTop && static_cast<int>(random() % 1000) >= promille) continue;
                    const int slot = static_cast<int>(random() % PageTable::kMostSlots);
                    there[{level, column, row}] = slot;
                    residents.push_back({{level, column, row}, slot});
                }
            }
        }
        table.fill(residents);
        for (int level = 0; level <= kTop; ++level) {
            for (int row = 0; row < 1 << (kTop - level); ++row) {
                for (int column = 0; column < 1 << (kTop - level); ++column) {
                    // From the top down, as long as the chain holds.
                    PageTable::Entry expected{there[{kTop, 0, 0}], there[{kTop, 0, 0}], kTop};
                    for (int k = kTop - 1; k >= level; --k) {
                        const auto found = there.find({k, column >> (k - level), row >> (k - level)});
                        if (found == there.end()) break;
                        expected = {found->second, expected.slot, k};
                    }
                    const auto entry = table.at({level, column, row});
                    EXPECT_EQ(entry.slot, expected.slot);
                    EXPECT_EQ(entry.parent_slot, expected.parent_slot);
                    EXPECT_EQ(entry.level, expected.level) << "seed " << kSeed;
                }
            }
        }
    }
}

TEST(PageSlots, ThePageThatWasWantedLongestAgoGoes) {
    PageSlots slots(3);
    const Page a{0, 1, 1};
    const Page b{1, 0, 0};
    const Page c{2, 0, 0};
    for (const Page& page : {a, b, c}) EXPECT_TRUE(slots.place(page, true));
    EXPECT_FALSE(slots.place({0, 5, 5}, true)) << "all are wanted now";
    slots.next_round();
    EXPECT_TRUE(slots.want(b));
    // Of a and c, wanted equally long ago, the finer goes.
    const auto of_a = slots.place({0, 6, 6}, true);
    ASSERT_TRUE(of_a);
    EXPECT_FALSE(slots.has(a));
    EXPECT_TRUE(slots.has(c));
    EXPECT_TRUE(slots.place({0, 7, 7}, true));
    EXPECT_FALSE(slots.has(c));
    EXPECT_FALSE(slots.place({0, 8, 8}, true));
    EXPECT_EQ(slots.want({0, 6, 6}), of_a);
}

TEST(PageSlots, WhatIsNotWantedTakesNoPlaceOfWhatIs) {
    PageSlots slots(2);
    EXPECT_TRUE(slots.place({2, 0, 0}, true));
    EXPECT_TRUE(slots.place({0, 1, 1}, false));
    EXPECT_TRUE(slots.place({0, 2, 2}, false));
    EXPECT_FALSE(slots.has({0, 1, 1}));
    EXPECT_TRUE(slots.has({2, 0, 0}));
}

}  // namespace
}  // namespace relevo::test
