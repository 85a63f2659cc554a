// Pages that come and go, without pictures: what is in a slot is told by the height of its first post.

#include "viewer/ground/ground_pages.hpp"

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "lod/pyramid/memory_pyramid.hpp"
#include "tests/lod/synthetic_terrain.hpp"
#include "viewer/ground/height_code.hpp"

namespace relevo::test {
namespace {

using viewer::Page;

/// A flat grid that says in each block's heights which one it is; with blocks that cannot be read.
class NumberedPyramid final : public lod::Pyramid {
  public:
    explicit NumberedPyramid(const geo::GridFrame& frame) : frame_(frame) {}

    const geo::GridFrame& frame() const override { return frame_; }

    Result<lod::VertexPosts> read_vertices(const Page&, lod::ErrorMetric) const override {
        return Error{ErrorKind::internal, "there are none"};
    }

    Result<lod::GroundPosts> read_ground(const Page& page) const override {
        if (delay.count() > 0) std::this_thread::sleep_for(delay);
        ++reads;
        if (damaged.count(page)) return Error{ErrorKind::damaged, "a block is damaged"};
        return lod::GroundPosts{lod::Raster<float>(257, 257, static_cast<float>(number(page))),
                                lod::Raster<lod::GroundPosts::Normal>(257, 257),
                                lod::Raster<std::uint8_t>(257, 257)};
    }

    /// 0 to 4 * 21 * 21 for the frame below.
    static int number(const Page& page) { return (page.level * 21 + page.row) * 21 + page.column; }

    std::set<Page> damaged;
    std::chrono::milliseconds delay{0};
    mutable std::atomic<int> reads = 0;

  private:
    geo::GridFrame frame_;
};

class GroundPagesTest : public testing::Test {
  protected:
    void make(int slots) {
        pages_ = std::move(*viewer::GroundPages::create(
            {.pyramid = &pyramid_,
             .facts = {.lowest_m = 0, .highest_m = 1e4},
             .report = [this](const std::string& line) { reports_.push_back(line); }},
            positions_, undulations_, slots,
            [this](int slot, const viewer::PageTexels& texels) { in_slot_[slot] = texels.posts[0][2]; }));
    }

    viewer::Sight look(double column, double row, double metres, double pitch = -90) const {
        const auto at = frame_.lat_lon({column, row});
        return viewer::Sight(lod::View({.eye = {at.lat, at.lon, {metres}},
                                        .heading = geo::Degrees{20},
                                        .pitch = geo::Degrees{pitch},
                                        .roll = {},
                                        .fov = geo::Degrees{60},
                                        .width = 1280,
                                        .height = 720}),
                             {0, 0, 1280, 720});
    }

    /// Every entry of the table leads to a slot that holds the page it says.
    void expect_table_is_true() const {
        const viewer::PageTable& table = pages_->table();
        for (int level = 0; level <= table.top(); ++level) {
            for (int row = 0; row < 1 << (table.top() - level); ++row) {
                for (int column = 0; column < 1 << (table.top() - level); ++column) {
                    const auto entry = table.at({level, column, row});
                    const int up = entry.level - level;
                    ASSERT_GE(up, 0);
                    expect_in_slot(entry.slot, {entry.level, column >> up, row >> up});
                    if (entry.level < table.top())
                        expect_in_slot(entry.parent_slot,
                                       {entry.level + 1, column >> (up + 1), row >> (up + 1)});
                }
            }
        }
    }

    void expect_in_slot(int slot, const Page& page) const {
        const double H = NumberedPyramid::number(page);
        ASSERT_TRUE(in_slot_.count(slot));
        ASSERT_EQ(in_slot_.at(slot), viewer::height_code({.lowest_m = 0, .highest_m = 1e4}).of(H));
    }

    const geo::GridFrame frame_ = geographic_frame(4097, 2500);
    const geo::PostPositions positions_{frame_};
    const lod::UndulationGrid undulations_;
    NumberedPyramid pyramid_{frame_};
    std::map<int, int> in_slot_;
    std::vector<std::string> reports_;
    std::unique_ptr<viewer::GroundPages> pages_;
};

TEST_F(GroundPagesTest, CountsPagesWithData) {
    // 16 x 10, 8 x 5, 4 x 3, 2 x 2, 1
    EXPECT_EQ(viewer::GroundPages::count(frame_, 4), 160u + 40 + 12 + 4 + 1);
    EXPECT_EQ(viewer::GroundPages::count(geographic_frame(5, 1), 0), 1u);
}

TEST_F(GroundPagesTest, TheTopIsThereFromTheStart) {
    make(100);
    EXPECT_EQ(pyramid_.reads, 1);
    EXPECT_EQ(pages_->table().at({0, 15, 9}).level, 4);
    expect_table_is_true();
}

TEST_F(GroundPagesTest, CompleteWaitsForAllAndAsksForNothingTwice) {
    make(300);
    pages_->want(look(1000, 1000, 12000), 1);
    EXPECT_GT(pages_->pending(), 3u);
    ASSERT_TRUE(pages_->complete());
    EXPECT_EQ(pages_->pending(), 0u);
    EXPECT_EQ(pages_->table().at({0, 3, 3}).level, 0);
    expect_table_is_true();
    const int reads = pyramid_.reads;
    for (int i = 0; i < 5; ++i) {
        pages_->want(look(1000, 1000, 12000), 1);
        ASSERT_TRUE(pages_->complete());
    }
    EXPECT_EQ(pyramid_.reads, reads);
}

TEST_F(GroundPagesTest, WhatIsSeenDoesNotDependOnWhatWasSeen) {
    make(300);
    pages_->want(look(1000, 1000, 12000), 1);
    ASSERT_TRUE(pages_->complete());
    std::vector<int> levels;
    for (int column = 0; column < 16; ++column) levels.push_back(pages_->table().at({0, column, 4}).level);
    for (const double column : {3000.0, 200.0}) {
        pages_->want(look(column, 900, 3000, -20), 1);
        ASSERT_TRUE(pages_->complete());
    }
    const int reads = pyramid_.reads;
    pages_->want(look(1000, 1000, 12000), 1);
    EXPECT_EQ(pages_->pending(), 0u) << "there was room to keep them";
    EXPECT_EQ(pyramid_.reads, reads);
    for (int column = 0; column < 16; ++column)
        EXPECT_EQ(pages_->table().at({0, column, 4}).level, levels[static_cast<std::size_t>(column)]);
}

TEST_F(GroundPagesTest, AFewSlotsAreFilledOnceAndStay) {
    for (const int slots : {1, 2, 5, 12}) {
        make(slots);
        const auto sight = look(1000, 1000, 4000, -15);
        EXPECT_FALSE(pages_->fits(sight, 1));
        pages_->want(sight, 1);
        ASSERT_TRUE(pages_->complete());
        EXPECT_EQ(pages_->pending(), 0u);
        expect_table_is_true();
        const int reads = pyramid_.reads;
        for (int i = 0; i < 3; ++i) {
            pages_->want(sight, 1);
            ASSERT_TRUE(pages_->complete());
        }
        EXPECT_EQ(pyramid_.reads, reads);
        EXPECT_LE(static_cast<int>(in_slot_.size()), slots);
        in_slot_.clear();
    }
}

// A flight that is too fast for its reads: nothing false in the table at any time, and all there in the end.
TEST_F(GroundPagesTest, AFastFlightIsNeverWrong) {
    pyramid_.delay = std::chrono::milliseconds(1);
    make(40);
    for (int i = 0; i < 200; ++i) {
        pages_->want(look(300 + 17 * i, 1200, 5000, -40), 1 + i % 3);
        pages_->take_ready(std::chrono::microseconds(300));
        expect_table_is_true();
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    ASSERT_TRUE(pages_->complete());
    EXPECT_EQ(pages_->pending(), 0u);
    expect_table_is_true();
}

TEST_F(GroundPagesTest, ADamagedPageIsDrawnAsItsParentAndReportedOnce) {
    pyramid_.damaged = {{1, 2, 2}, {0, 0, 0}};
    make(300);
    for (int i = 0; i < 3; ++i) {
        pages_->want(look(1200, 1200, 3000), 1);
        const auto done = pages_->complete();
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().kind, ErrorKind::damaged);
        EXPECT_EQ(pages_->pending(), 0u);
        expect_table_is_true();
        EXPECT_EQ(pages_->table().at({0, 4, 4}).level, 2);
        EXPECT_EQ(reports_.size(), 1u);
    }
    pages_->want(look(3600, 2000, 3000), 1);
    EXPECT_TRUE(pages_->complete()) << "the damage is elsewhere";
    EXPECT_EQ(reports_.size(), 1u);
}

TEST_F(GroundPagesTest, WithoutItsTopThereIsNoGround) {
    pyramid_.damaged = {{4, 0, 0}};
    const auto made = viewer::GroundPages::create({.pyramid = &pyramid_}, positions_, undulations_, 9,
                                                  [](int, const viewer::PageTexels&) {});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, ErrorKind::damaged);
}

TEST(PageTexels, GoOnBeyondTheDataAndKnowTheirVoids) {
    const auto frame = geographic_frame(301, 701);
    const auto heights = make_heights(frame, [](int column, int row) {
        return column == 100 && row == 60 ? static_cast<double>(kVoid) : 1000.0 + column;
    });
    lod::Raster<std::uint8_t> sea(301, 701);
    for (int row = 0; row < 701; ++row) {
        for (int column = 290; column < 301; ++column) sea.at(column, row) = 255;
    }
    const lod::MemoryPyramid pyramid(frame, heights, {}, sea);
    const auto read = viewer::ground_facts(pyramid);
    ASSERT_TRUE(read);
    const viewer::GroundFacts& facts = *read;
    EXPECT_EQ(facts.lowest_m, 1000);
    EXPECT_EQ(facts.highest_m, 1300);
    EXPECT_EQ(facts.lowest_land_m, 1000);
    EXPECT_TRUE(facts.has_voids);
    EXPECT_TRUE(facts.has_sea);
    for (int level = 0; level <= pyramid.top(); ++level) {
        const Page page{level, level == 0 ? 1 : 0, 0};
        const auto posts = pyramid.read_ground(page);
        ASSERT_TRUE(posts);
        const auto texels = viewer::page_texels(page, *posts, frame, facts);
        ASSERT_EQ(texels.posts.size(), 257u * 257);
        ASSERT_EQ(texels.cells.size(), 256u * 256);
        const int last = ((frame.columns - 1) >> level) - page.column * 256;
        for (int row = 0; row < 257; row += 8) {
            const auto* line = texels.posts.data() + row * 257;
            for (int column = last + 1; column < 257; ++column) {
                EXPECT_EQ(line[column], line[last]);
                const viewer::PageTexels::Shore at_sea{255, 0};
                EXPECT_EQ(texels.shore[static_cast<std::size_t>(row * 257 + column)], at_sea);
            }
            for (int column = 0; column <= last; ++column) {
                if (line[column][3] == 0) continue;
                const int at = (column + page.column * 256) << level;
                EXPECT_EQ(line[column][3], 32767);
                EXPECT_EQ(line[column][2], viewer::height_code(facts).of(1000 + at));
            }
        }
        for (int row = 0; row < 256; ++row) {
            for (int column = 0; column < 256; ++column) {
                // A cell of the level has the void post at a corner only where the level has that post.
                const int x = (column + page.column * 256) << level;
                const int y = row << level;
                const bool on_level = 100 % (1 << level) == 0 && 60 % (1 << level) == 0;
                const bool touches =
                    (x == 100 || x + (1 << level) == 100) && (y == 60 || y + (1 << level) == 60);
                EXPECT_EQ(texels.cells[static_cast<std::size_t>(row * 256 + column)],
                          on_level && touches ? 0 : 255)
                    << level << " " << column << " " << row;
            }
        }
    }
}

}  // namespace
}  // namespace relevo::test
