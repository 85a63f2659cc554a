// The pyramid of a scene on disk against that of the same rasters in memory, post by post.

#include "lod/pyramid/scene_pyramid.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "lod/pyramid/memory_pyramid.hpp"
#include "tests/lod/same_pyramid.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::test {
namespace {

using lod::HeightType;
using lod::MemoryPyramid;
using lod::PyramidBlock;
using lod::ScenePyramid;

/// A scene of a frame with heights from a function (NaN: void), sea where they are below 0.
template <class Height>
SceneParts scene_of(const geo::GridFrame& frame, HeightType type, Height height) {
    SceneParts parts;
    parts.info.frame = frame;
    parts.info.height_type = type;
    parts.info.height_min_m = -1e5;
    parts.info.height_max_m = 1e5;
    parts.info.resampling_method = "none";
    parts.heights = make_heights(frame, [&](int column, int row) {
        return type == HeightType::int16 ? std::round(height(column, row)) : height(column, row);
    });
    parts.marks = lod::plain_marks(parts.heights);
    for (std::size_t i = 0; i < parts.heights.samples().size(); ++i) {
        const float H = parts.heights.samples()[i];
        ++(std::isnan(H) ? parts.info.void_posts : parts.info.valid_posts);
        if (H >= 0 || std::isnan(H)) continue;
        parts.marks.samples()[i].set_class(lod::PostClass::sea);
        ++parts.info.sea_posts;
    }
    if (frame.closes()) {
        parts.info.vertical = {lod::VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
    } else {
        parts.geoid = sloping_geoid(frame, 3, 7);
    }
    parts.metrics = lod::build_metrics(frame, parts.undulations(), parts.heights);
    return parts;
}

MemoryPyramid in_memory(const SceneParts& parts) {
    lod::Raster<std::uint8_t> sea(parts.heights.columns(), parts.heights.rows());
    for (std::size_t i = 0; i < sea.samples().size(); ++i)
        sea.samples()[i] = parts.marks.samples()[i].post_class() == lod::PostClass::sea ? 255 : 0;
    return {parts.info.frame, parts.heights, parts.metrics, sea};
}

lod::Scene written(const SceneParts& parts, const SceneFolder& folder) {
    const auto done = write_scene(parts, folder / "a.relevo");
    EXPECT_TRUE(done) << done.error().message;
    auto scene = lod::Scene::open(folder / "a.relevo");
    EXPECT_TRUE(scene) << scene.error().message;
    return *std::move(scene);
}

void expect_as_in_memory(const SceneParts& parts) {
    const SceneFolder folder;
    const auto pyramid = ScenePyramid::open(written(parts, folder));
    ASSERT_TRUE(pyramid) << pyramid.error().message;
    expect_same_pyramid(*pyramid, in_memory(parts));
}

/// Mountains in a sea, with a wide void, narrow ones, and single posts.
double islands(int column, int row) {
    const bool wide = std::abs(column - 300) < 90 && std::abs(row - 250) < 40;
    if (wide || noise(column, row) < 0.01 || column % 97 == 5)
        return std::numeric_limits<double>::quiet_NaN();
    return mountains(column, row) - 1200;
}

TEST(ScenePyramid, VoidsAndSeaAtHighLatitude) {
    expect_as_in_memory(scene_of(geographic_frame(1025, 530, 83), HeightType::float32, islands));
}

TEST(ScenePyramid, WholeMetresAndPaddingBeyondABlocksBorder) {
    // The data ends one post before a border of blocks of levels 0 and 1.
    expect_as_in_memory(scene_of(geographic_frame(512, 768), HeightType::int16, islands));
}

TEST(ScenePyramid, AroundAPole) {
    expect_as_in_memory(
        scene_of(polar_frame(geo::FrameKind::ups_south, 600, 520, 90), HeightType::float32, islands));
}

TEST(ScenePyramid, RoundTheEarth) {
    const geo::GridFrame frame{geo::FrameKind::geographic, -180, 90, 0.5, 0.5, 721, 361};
    ASSERT_TRUE(frame.closes());
    const SceneParts parts = scene_of(frame, HeightType::float32, [](int column, int row) {
        return 4000 * std::cos(column * std::numbers::pi / 18) * std::sin(row * std::numbers::pi / 20);
    });
    expect_as_in_memory(parts);
}

TEST(ScenePyramid, SmallGridsAreOneBlock) {
    expect_as_in_memory(scene_of(geographic_frame(200, 100), HeightType::int16, islands));
    expect_as_in_memory(scene_of(geographic_frame(2, 1), HeightType::float32, mountains));
}

TEST(ScenePyramid, OfOneLevelMoreThanABlock) {
    expect_as_in_memory(scene_of(geographic_frame(513, 300), HeightType::int16, islands));
}

TEST(ScenePyramid, LevelsOfTheLattice) {
    const SceneParts parts = scene_of(geographic_frame(4097, 20), HeightType::int16, islands);
    ASSERT_EQ(LevelGrid::top(parts.info.frame.levels()), 4);
    expect_as_in_memory(parts);
}

// Three valid posts in a million: blocks without any are not stored, and those around them are.
TEST(ScenePyramid, NearlyAllVoid) {
    const SceneParts parts =
        scene_of(geographic_frame(1500, 840), HeightType::float32, [](int column, int row) {
            const bool valid =
                (column == 3 && row == 1) || (column == 512 && row == 777) || (column == 1499 && row == 839);
            return valid ? 100.0 + column : std::numeric_limits<double>::quiet_NaN();
        });
    expect_as_in_memory(parts);
    const SceneFolder folder;
    const lod::SceneInfo info = written(parts, folder).info();
    EXPECT_LE(info.levels.at(0).vertices.size(), 6U);
    EXPECT_EQ(info.levels.at(2).vertices.size(), 1U);
}

TEST(ScenePyramid, WithoutBoundedErrorsTheIncrementalOnesStandIn) {
    SceneParts parts = scene_of(geographic_frame(600, 70), HeightType::int16, islands);
    parts.info.bounded_errors = false;
    parts.metrics = lod::build_metrics(parts.info.frame, parts.undulations(), parts.heights,
                                       lod::ObjectErrors::incremental);
    const SceneFolder folder;
    const auto pyramid = ScenePyramid::open(written(parts, folder));
    ASSERT_TRUE(pyramid);
    for (const PyramidBlock& block : {PyramidBlock{0, 1, 0}, PyramidBlock{1, 0, 0}, PyramidBlock{2, 0, 0}}) {
        const auto bounded = pyramid->read_vertices(block, lod::ErrorMetric::bounded);
        const auto incremental = pyramid->read_vertices(block, lod::ErrorMetric::incremental);
        ASSERT_TRUE(bounded && incremental);
        EXPECT_EQ(bounded->error.samples(), incremental->error.samples());
        EXPECT_GT(std::ranges::max(bounded->error.samples()), 0);
    }
}

TEST(ScenePyramid, GivesTheSameToManyThreadsWhateverItKeeps) {
    const SceneParts parts = scene_of(geographic_frame(1025, 530), HeightType::int16, islands);
    const SceneFolder folder;
    const lod::Scene scene = written(parts, folder);
    const auto ample = ScenePyramid::open(scene);
    const auto tight = ScenePyramid::open(scene, 0);
    ASSERT_TRUE(ample && tight);
    tbb::parallel_for(0, 4 * 12, [&](int i) {
        const PyramidBlock block{0, i % 4, i / 4 % 3};
        const auto a = ample->read_vertices(block, lod::ErrorMetric::bounded);
        const auto b = tight->read_vertices(block, lod::ErrorMetric::bounded);
        ASSERT_TRUE(a && b);
        EXPECT_TRUE(same_bits(a->heights, b->heights));
        EXPECT_EQ(a->error.samples(), b->error.samples());
        const auto c = ample->read_ground(block);
        const auto d = tight->read_ground(block);
        ASSERT_TRUE(c && d);
        EXPECT_EQ(c->normals.samples(), d->normals.samples());
        EXPECT_EQ(c->is_sea.samples(), d->is_sea.samples());
    });
}

}  // namespace
}  // namespace relevo::test
