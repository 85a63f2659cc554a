// The LSTR's two halves as a program uses them.

#include <cmath>

#include <gtest/gtest.h>

#include "ingest/lstr_generator.hpp"
#include "lod/lstr/chunk_file.hpp"
#include "lod/soar/pick.hpp"
#include "tests/viewer/scene_for_pictures.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/lstr_viewer.hpp"

namespace relevo::test {
namespace {

using ingest::LstrGenerator;
using viewer::LstrViewer;

class LstrLibrary : public testing::Test {
  protected:
    LstrLibrary() : scene_((folder_ / "mountains.relevo").string()) { write_mountains(scene_); }

    SceneFolder folder_;
    std::string scene_;
};

TEST_F(LstrLibrary, SimplifyFindsWhatALoopFinds) {
    const auto generator = must(LstrGenerator::open(scene_));
    const auto heights = must(generator.scene().read_all_heights());
    const float margin = lod::margin_of_range(heights, 0.2);
    for (const auto test : {lod::RemovalTest::pairs, lod::RemovalTest::mean}) {
        const auto found = must(generator.simplify(0.2, test));
        int removed = 0;
        for (int row = 1; row + 1 < heights.rows(); ++row) {
            for (int column = 1; column + 1 < heights.columns(); ++column) {
                const auto at = [&](int x, int y) { return heights.at(column + x, row + y); };
                const auto near = [&](float mean) { return std::abs(mean - at(0, 0)) <= margin; };
                const bool pairs =
                    near(0.5F * (at(-1, -1) + at(1, 1))) && near(0.5F * (at(0, -1) + at(0, 1))) &&
                    near(0.5F * (at(1, -1) + at(-1, 1))) && near(0.5F * (at(1, 0) + at(-1, 0)));
                if (test == lod::RemovalTest::pairs) {
                    EXPECT_EQ(found.contains({column, row}), pairs) << column << " " << row;
                }
                removed += found.contains({column, row});
            }
        }
        EXPECT_GT(removed, 100);
        EXPECT_LT(removed, 127 * 127);
    }
    EXPECT_FALSE(must(generator.simplify(100)).contains({0, 5}));  // on the border
}

TEST_F(LstrLibrary, GenerateMakesTheFileAndGoesOnWhereItWasStopped) {
    const auto generator = must(LstrGenerator::open(scene_));
    EXPECT_FALSE(generator.generate({}, [](double) { return false; }));
    EXPECT_FALSE(lod::ChunkFile::is_there(generator.scene()));
    must(generator.generate());
    EXPECT_TRUE(lod::ChunkFile::is_there(generator.scene()));
    const auto made = std::filesystem::last_write_time(scene_ + "/chunks.bin");
    must(generator.generate());
    EXPECT_EQ(std::filesystem::last_write_time(scene_ + "/chunks.bin"), made);
    EXPECT_FALSE(LstrGenerator::open(folder_ / "none.relevo"));
}

// Every pixel is held against a ray through the full data.
TEST_F(LstrLibrary, GroundIsDrawnWhereGroundIsAndNowhereElse) {
    const auto context = must(viewer::OffscreenContext::create());
    auto viewer = must(LstrViewer::load(scene_, {.look = {.background = kMagenta}, .waits = true}));
    EXPECT_TRUE(std::filesystem::exists(scene_ + "/chunks.bin"));
    const auto target = must(viewer::RenderTarget::create(160, 90, 1));
    auto camera = above_looking_down(viewer.terrain(), 64, 125, 1200, 160, 90);
    camera.fov.value = 60;
    for (const double pitch : {-15.0, -5.0}) {
        camera.pitch.value = pitch;
        must(viewer.update(camera, 0.1));
        must(viewer.draw(target, 0.1));
        viewer::Picture picture(160, 90);
        target.read_into(picture, 0, 0);
        const lod::View view(camera);
        const auto hit = [&](double x, double y) {
            return lod::pick_exactly(viewer.terrain(), view.eye(), view.ray({x, y}), 1).has_value();
        };
        int ground = 0, sky = 0;
        for (int y = 3; y < 87; y += 2) {
            for (int x = 3; x < 157; x += 3) {
                const double u = x + 0.5, v = y + 0.5;
                const bool here = hit(u, v);
                if (hit(u - 2, v) != here || hit(u + 2, v) != here || hit(u, v - 2) != here ||
                    hit(u, v + 2) != here)
                    continue;  // tau moves outlines
                EXPECT_EQ(is_magenta(picture.at(x, y)), !here) << x << " " << y;
                ++(here ? ground : sky);
            }
        }
        EXPECT_GT(ground, 200) << pitch;
        EXPECT_GT(sky, 100) << pitch;
        EXPECT_GT(viewer.figures().triangles, 50U);
        EXPECT_EQ(viewer.figures().pending_pages, 0U);
    }
}

TEST_F(LstrLibrary, TimeGoesOnInTheWavesAndWhatIsMissingComesInTheBackground) {
    const auto context = must(viewer::OffscreenContext::create());
    auto viewer = must(LstrViewer::load(scene_));
    const auto target = must(viewer::RenderTarget::create(80, 45, 1));
    const auto camera = above_looking_down(viewer.terrain(), 64, 64, 1500, 80, 45);
    for (int frame = 0; frame < 2000; ++frame) {
        must(viewer.update(camera, 0.02));
        must(viewer.draw(target, 0.25));
        const auto figures = viewer.figures();
        if (frame >= 3 && figures.chunks.store.pending_groups == 0 && figures.pending_pages == 0) break;
        ASSERT_LT(frame, 1999);
    }
    EXPECT_GE(viewer.look().ocean.time_s, 1);
    EXPECT_FALSE(LstrViewer::load(folder_ / "none.relevo"));
}

TEST(SwapFactorAhead, GrowsWithSpeedOverHeightAndIsBounded) {
    using viewer::swap_factor_ahead;
    EXPECT_EQ(swap_factor_ahead(1.2, 0, 100), 1.2);
    EXPECT_NEAR(swap_factor_ahead(1.2, 100, 1000), 1.27, 1e-9);
    EXPECT_EQ(swap_factor_ahead(1.2, 1e6, 1000), 2.2);
    EXPECT_EQ(swap_factor_ahead(1.2, 100, -50), 2.2);  // below the ground
}

}  // namespace
}  // namespace relevo::test
