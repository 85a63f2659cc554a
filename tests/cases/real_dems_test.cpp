// The guarantee on real elevation models, from the file to the measured picture: imported as a user would,
// meshed with the bounded metric, and judged by the oracle. `relevo check` does the same with more views.

#include <gtest/gtest.h>

#include "lod/scene_check.hpp"
#include "tests/cases/real_dem.hpp"
#include "tests/lod/same_pyramid.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::lod {
namespace {

using test::RealDem;

const RealDem kDems[] = {
    {"everest", "mountains/mt_everest_90m.tif", ""},           // voids, extreme relief
    {"baltoro", "mountains/baltoro.tif", ""},                  // not square
    {"bigtujunga", "mountains/bigtujunga.tif", ""},            // warped from UTM
    {"nice", "coast/N43E007.hgt.zip", ""},                     // coast, voids
    {"netherlands", "coast/netherlands_30s.nc", "EPSG:4326"},  // coarse: the earth is round
};

class RealDems : public testing::TestWithParam<RealDem> {};

TEST_P(RealDems, KeepTheErrorOnEveryView) {
    RELEVO_NEEDS_DATA(GetParam().file);
    const test::SceneFolder folder;
    const auto scene = test::import_real(GetParam(), folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto terrain = Terrain::open(*scene, ErrorMetric::bounded, {.fade_s = 0});
    ASSERT_TRUE(terrain) << terrain.error().message;

    const auto cameras = sample_views(*terrain, 8, 20261122, 480, 270);
    for (const double tau : {0.5, 2.0}) {
        for (const bool morph : {false, true}) {
            const auto checked = check_views(*terrain, ErrorMetric::bounded, cameras, tau, morph);
            ASSERT_TRUE(checked) << checked.error().message;
            const ViewsCheck& check = *checked;
            EXPECT_LE(check.max_px, tau);
            EXPECT_GT(check.max_px, 0.05 * tau) << "the bound is of use";
            EXPECT_GE(check.views_with_ground, 6);
            EXPECT_EQ(check.uncovered_posts, 0u);
            EXPECT_EQ(check.t_vertices, 0);
            EXPECT_EQ(check.torn_posts, 0);
        }
    }
}

// What is read block by block, of every level, is what the whole of it has in memory.
TEST_P(RealDems, HaveOnePyramidOnDiskAndInMemory) {
    RELEVO_NEEDS_DATA(GetParam().file);
    const test::SceneFolder folder;
    const auto scene = test::import_real(GetParam(), folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto heights = scene->read_all_heights();
    ASSERT_TRUE(heights);
    Raster<std::uint8_t> sea(heights->columns(), heights->rows());
    const BlockGrid grid = BlockGrid::of_heights(heights->columns(), heights->rows());
    for (int i = 0; i < grid.count(); ++i) {
        const BlockGrid::Box box = grid.box(i % grid.across, i / grid.across);
        const auto marks = scene->read_marks(i % grid.across, i / grid.across, part_of(*heights, box));
        ASSERT_TRUE(marks);
        for (int row = 0; row < box.rows; ++row) {
            for (int column = 0; column < box.columns; ++column)
                sea.at(box.column + column, box.row + row) =
                    marks->at(column, row).post_class() == PostClass::sea ? 255 : 0;
        }
    }
    const auto pyramid = ScenePyramid::open(*scene);
    ASSERT_TRUE(pyramid) << pyramid.error().message;
    const geo::GridFrame& frame = scene->info().frame;
    test::expect_same_pyramid(
        *pyramid, MemoryPyramid(frame, *heights, build_metrics(frame, scene->undulations(), *heights), sea));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, RealDems, testing::ValuesIn(kDems),
                         [](const auto& dem) { return std::string(dem.param.name); });

}  // namespace
}  // namespace relevo::lod
