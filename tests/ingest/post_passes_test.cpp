#include "ingest/posts/post_passes.hpp"

#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "ingest/posts/fill_voids.hpp"
#include "lod/scene/scene_writer.hpp"
#include "tests/ingest/classifying.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::ingest {
namespace {

using test::Heights;
using test::Marks;

/// Hills by a sea of exactly 0, with voids of all sizes and wrong posts.
Heights coast(int columns, int rows) {
    std::mt19937 random{11};
    Heights heights(columns, rows);
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const double H =
                80 * std::sin(0.013 * c) * std::cos(0.017 * r) + 40 * std::sin(0.05 * c + 0.03 * r);
            heights.at(c, r) = static_cast<float>(std::max(std::round(H), H > -60 ? 0.0 : -4.0));
        }
    }
    for (int i = 0; i < 400; ++i) {
        const int size = 1 + static_cast<int>(random() % 7);
        const int column = static_cast<int>(random() % static_cast<unsigned>(columns - size));
        const int row = static_cast<int>(random() % static_cast<unsigned>(rows - size));
        for (int r = row; r < row + size; ++r) {
            for (int c = column; c < column + size; ++c) heights.at(c, r) = std::nanf("");
        }
    }
    // Nobody surveyed the corner of the sea.
    for (int r = rows - 90; r < rows; ++r) {
        for (int c = 480; c < 620; ++c) heights.at(c, r) = std::nanf("");
    }
    for (int i = 0; i < 200; ++i)
        heights.at(static_cast<int>(random() % static_cast<unsigned>(columns)),
                   static_cast<int>(random() % static_cast<unsigned>(rows))) = 7000;
    return heights;
}

/// The same steps on all of the raster at once.
test::Classified at_once(const Heights& heights, const geo::GridFrame& frame, const PostChanges& changes) {
    test::Classified all{heights, test::marks_of(heights), {}};
    const Window whole{0, 0, heights.columns(), heights.rows()};
    if (changes.despike) despike(all.heights, all.marks, whole, 0, 0);
    if (changes.fill_width > 0) {
        EXPECT_TRUE(fill_voids(all.heights, all.marks, whole, changes.fill_width, changes.whole_metres));
    }
    auto sea = SeaClassifier::create(frame, {}, 4096);
    sea->add_block(0, 0, all.heights, all.marks);
    all.info = sea->decide();
    EXPECT_TRUE(sea->mark_block(0, 0, all.heights, all.marks));
    model_sea_bed(frame, 0, 0, whole, all.heights, all.marks);
    return all;
}

TEST(PostPasses, AreTheSameBlockByBlock) {
    const Heights heights = coast(1100, 700);
    const auto frame = test::frame_for(heights);
    for (const PostChanges& changes : {PostChanges{}, PostChanges{true, 0, false},
                                       PostChanges{false, 3, true}, PostChanges{true, 4, false}}) {
        const test::SceneFolder folder;
        auto writer = lod::SceneWriter::create(folder / "a.relevo", {});
        ASSERT_TRUE(writer) << writer.error().message;
        const lod::HeightCoding coding;
        auto raw = writer->draft("raw", frame, coding, std::uint64_t{64} << 20);
        auto cleaned = writer->draft("cleaned", frame, coding, std::uint64_t{64} << 20);
        ASSERT_TRUE(raw && cleaned);
        const Marks marks = test::marks_of(heights);
        for (const Window& block : test::blocks_of(1100, 700, 512))
            ASSERT_TRUE(raw->write(block.column / 512, block.row / 512,
                                   {test::part(heights, block), test::part(marks, block)}));

        const test::Classified expected = at_once(heights, frame, changes);
        auto sea = SeaClassifier::create(frame, {});
        ASSERT_TRUE(sea);
        const Progress none;
        const auto outliers = clean_posts(*raw, changes, *cleaned, *sea, Stage{none, 0, 1});
        ASSERT_TRUE(outliers) << outliers.error().message;
        EXPECT_GT(outliers->count, 100U);
        EXPECT_EQ(sea->decide().text, expected.info.text);
        std::uint64_t modelled = 0;
        for (const Window& block : test::blocks_of(1100, 700, 512)) {
            const auto posts = classified_block(*cleaned, frame, *sea, block.column / 512, block.row / 512);
            ASSERT_TRUE(posts) << posts.error().message;
            EXPECT_EQ(posts->marks.samples(), test::part(expected.marks, block).samples());
            EXPECT_TRUE(test::same_bits(posts->heights, test::part(expected.heights, block)));
            for (const auto mark : posts->marks.samples()) modelled += mark.modelled() ? 1 : 0;
        }
        EXPECT_GT(modelled, 0U);
        EXPECT_GT(expected.sea(), 10000U);
    }
}

}  // namespace
}  // namespace relevo::ingest
