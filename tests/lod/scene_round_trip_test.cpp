// What goes into a scene comes out of it, bit by bit, whatever its size; and the same input gives the same
// bytes.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

using lod::HeightType;
using lod::Scene;

struct Shape {
    int columns;
    int rows;
};

class SceneShapes : public testing::TestWithParam<Shape> {};

TEST_P(SceneShapes, ComeBackBitByBit) {
    const auto [columns, rows] = GetParam();
    for (const HeightType type : {HeightType::int16, HeightType::float32}) {
        const SceneFolder folder;
        const SceneParts parts = made_up_scene(columns, rows, type);
        const auto written = write_scene(parts, folder / "a.relevo");
        ASSERT_TRUE(written) << written.error().message;
        const auto scene = Scene::open(folder / "a.relevo");
        ASSERT_TRUE(scene) << scene.error().message;

        const auto heights = scene->read_all_heights();
        ASSERT_TRUE(heights) << heights.error().message;
        EXPECT_TRUE(same_bits(*heights, parts.heights));
        const auto metrics = metrics_of(*scene);
        ASSERT_TRUE(metrics) << metrics.error().message;
        EXPECT_EQ(metrics->bounded.samples(), parts.metrics.bounded.samples());
        EXPECT_EQ(metrics->incremental.samples(), parts.metrics.incremental.samples());
        EXPECT_EQ(metrics->radius.samples(), parts.metrics.radius.samples());
        const lod::UndulationGrid N = parts.undulations();
        for (const int post : {0, 1, parts.info.frame.padded_side() - 1})
            EXPECT_EQ(scene->undulations().at(post, post / 2), N.at(post, post / 2));
        EXPECT_TRUE(scene->verify().empty());

        const geo::GridFrame& frame = scene->info().frame;
        EXPECT_EQ(frame.west, parts.info.frame.west);
        EXPECT_EQ(frame.north, parts.info.frame.north);
        EXPECT_EQ(frame.step_x, parts.info.frame.step_x);
        EXPECT_EQ(frame.step_y, parts.info.frame.step_y);
        EXPECT_EQ(scene->info().valid_posts, parts.info.valid_posts);
        EXPECT_EQ(scene->info().height_type, type);
    }
}

INSTANTIATE_TEST_SUITE_P(SizesAroundABlock, SceneShapes,
                         testing::Values(Shape{1, 1}, Shape{1, 9}, Shape{2, 2}, Shape{3, 3}, Shape{511, 512},
                                         Shape{512, 513}, Shape{513, 2}, Shape{1025, 514}, Shape{1400, 3}));

TEST(SceneRoundTrip, BlocksAreThePartsOfTheWhole) {
    const SceneFolder folder;
    const SceneParts parts = made_up_scene(700, 513);
    ASSERT_TRUE(write_scene(parts, folder / "a.relevo"));
    const auto scene = Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene);
    const auto corner = scene->read_heights(1, 1);
    ASSERT_TRUE(corner) << corner.error().message;
    EXPECT_EQ(corner->columns(), 188);
    EXPECT_EQ(corner->rows(), 1);
    for (int column = 0; column < 188; ++column) {
        EXPECT_EQ(corner->at(column, 0), parts.heights.at(512 + column, 512));
    }
}

TEST(SceneRoundTrip, BlocksOfVoidsAndOfZeroMetricsCostNothing) {
    const SceneFolder folder;
    SceneParts parts = made_up_scene(1025, 1025);
    parts.info.valid_posts = 1;
    parts.info.void_posts = 1025 * 1025 - 1;
    std::ranges::fill(parts.heights.samples(), std::numeric_limits<float>::quiet_NaN());
    parts.heights.at(1024, 3) = 12;
    parts.metrics = lod::build_metrics(parts.info.frame, parts.undulations(), parts.heights);
    ASSERT_TRUE(write_scene(parts, folder / "a.relevo"));
    const auto scene = Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->info().heights.size(), 1U);
    for (const lod::LevelInfo& level : scene->info().levels) EXPECT_EQ(level.vertices.size(), 1U);
    EXPECT_EQ(scene->info().marks.size(), 0U);
    const auto heights = scene->read_all_heights();
    ASSERT_TRUE(heights);
    EXPECT_TRUE(same_bits(*heights, parts.heights));
    EXPECT_EQ(metrics_of(*scene)->radius.samples(), parts.metrics.radius.samples());
}

TEST(SceneRoundTrip, HeightsAboveTheEllipsoidNeedNoUndulations) {
    const SceneFolder folder;
    SceneParts parts = made_up_scene(20, 10);
    parts.geoid.reset();
    parts.info.vertical = {lod::VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
    ASSERT_TRUE(write_scene(parts, folder / "a.relevo"));
    const auto scene = Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->info().vertical.datum, lod::VerticalDatum::ellipsoid);
    EXPECT_FALSE(scene->info().vertical.assumed);
    EXPECT_EQ(scene->undulations().at(5, 5), 0);
}

TEST(SceneRoundTrip, SameBytesWhateverTheThreads) {
    const SceneFolder folder;
    const SceneParts parts = made_up_scene(1500, 1100);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        ASSERT_TRUE(write_scene(parts, folder / "one.relevo"));
    }
    ASSERT_TRUE(write_scene(parts, folder / "many.relevo"));
    EXPECT_EQ(all_files(folder / "one.relevo"), all_files(folder / "many.relevo"));
}

TEST(SceneRoundTrip, HeightsThatTheTypeCannotHoldAreRefused) {
    for (const float height : {0.5F, 40000.F, -32768.F, std::numeric_limits<float>::infinity()}) {
        const SceneFolder folder;
        SceneParts parts = made_up_scene(600, 2, HeightType::int16);
        parts.heights.at(550, 0) = height;
        EXPECT_FALSE(write_scene(parts, folder / "a.relevo")) << height;
        EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << height;
    }
}

TEST(SceneRoundTrip, NothingTellsWhenOrWhereItWasMade) {
    const SceneFolder folder;
    ASSERT_TRUE(write_scene(made_up_scene(20, 10), folder / "a.relevo"));
    for (const auto& [name, text] : all_files(folder / "a.relevo")) {
        EXPECT_EQ(text.find(folder.path().string()), std::string::npos) << name;
    }
}

}  // namespace
}  // namespace relevo::test
