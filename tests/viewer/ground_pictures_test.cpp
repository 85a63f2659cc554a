// Pictures of grounds of several pages: no borders of pages or levels show, and damage is told.

#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"
#include "viewer/camera.hpp"
#include "viewer/offscreen.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;

constexpr int kColumns = 1100;  // 5 x 3 pages and 3 levels, none of which the data fills
constexpr int kRows = 700;

lod::Camera over(const lod::Terrain& terrain, double column, double row, double metres, double pitch,
                 double heading = 0) {
    auto camera = above_looking_down(terrain, column, row, metres, 320, 240);
    camera.pitch.value = pitch;
    camera.heading.value = heading;
    return camera;
}

TEST(GroundPictures, APlaneHasOneSlopeAcrossPagesAndLevels) {
    const auto frame = geographic_frame(kColumns, kRows, 0.1);  // where columns are as far apart everywhere
    const double rise = 0.4 * frame.spacing({0, 0}).column_m;
    Studio studio(
        make_terrain(frame, make_heights(frame, [&](int column, int) { return 100 + rise * column; })));
    const auto ramp = viewer::colour_ramp(Layer::slope);
    const double degrees = std::atan(0.4) * 180 / 3.14159265358979;
    const auto expected =
        ramp[static_cast<std::size_t>(std::lround(degrees / 60 * static_cast<double>(ramp.size() - 1)))];
    int ground = 0;
    for (const auto& camera :
         {over(studio.terrain(), 500, 300, 20000, -90), over(studio.terrain(), 20, 400, 3000, -25, 80),
          over(studio.terrain(), 700, 690, 12000, -50, 350), over(studio.terrain(), 550, 350, 90000, -90)}) {
        const auto picture = studio.draw(camera, {.layer = Layer::slope, .background = kMagenta});
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const auto pixel = picture.at(x, y);
                if (is_magenta(pixel)) continue;
                ++ground;
                for (std::size_t i = 0; i < 3; ++i)
                    ASSERT_NEAR(pixel[i], expected[i], 2) << x << " " << y << " channel " << i;
            }
        }
    }
    EXPECT_GT(ground, 100000);
}

// Tints of a plane change by little from pixel to pixel, whatever page they come from.
TEST(GroundPictures, TintsRunOnAcrossPagesAndLevels) {
    const auto frame = geographic_frame(kColumns, kRows, 0.1);
    Studio studio(make_terrain(frame, make_heights(frame, [](int column, int row) { return column + row; })));
    const auto sun = *viewer::parse_sun("0,90");
    for (const auto& camera :
         {over(studio.terrain(), 500, 300, 12000, -90), over(studio.terrain(), 20, 680, 3000, -25, 45),
          over(studio.terrain(), 550, 350, 50000, -90)}) {
        const auto picture = studio.draw(camera, {.sun = sun, .background = kMagenta});
        int pairs = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 1; x < picture.width; ++x) {
                const auto a = picture.at(x - 1, y);
                const auto b = picture.at(x, y);
                if (is_magenta(a) || is_magenta(b)) continue;
                ++pairs;
                for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(a[i], b[i], 3) << x << " " << y;
            }
        }
        EXPECT_GT(pairs, 5000);
    }
}

TEST(GroundPictures, DoNotDependOnWhatWasSeenBefore) {
    const auto frame = geographic_frame(kColumns, kRows);
    const auto heights = make_heights(frame, [](int column, int row) {
        return noise(column / 5, row / 5) < 0.003 ? static_cast<double>(kVoid) : mountains(column, row);
    });
    lod::Raster<std::uint8_t> sea(kColumns, kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column)
            sea.at(column, row) = mountains(column, row) < 1200 ? 255 : 0;
    }
    Studio studio(make_terrain(frame, heights, lod::ErrorMetric::bounded, {}, sea));
    const auto far = over(studio.terrain(), 550, 350, 60000, -60);
    const auto near = over(studio.terrain(), 300, 600, 2500, -20, 30);
    const auto first = studio.draw(far, {.background = kMagenta});
    studio.draw(near, {.background = kMagenta});
    EXPECT_EQ(studio.draw(far, {.background = kMagenta}).rgb, first.rgb);
}

/// A pyramid in which a block is damaged.
class DamagedPyramid final : public lod::Pyramid {
  public:
    DamagedPyramid(const lod::Pyramid& whole, const lod::PyramidBlock& damaged)
        : whole_(whole), damaged_(damaged) {}
    const geo::GridFrame& frame() const override { return whole_.frame(); }
    Result<lod::VertexPosts> read_vertices(const lod::PyramidBlock& block,
                                           lod::ErrorMetric metric) const override {
        return whole_.read_vertices(block, metric);
    }
    Result<lod::GroundPosts> read_ground(const lod::PyramidBlock& block) const override {
        if (block == damaged_) return Error{ErrorKind::damaged, "block 1, 1 is damaged"};
        return whole_.read_ground(block);
    }

  private:
    const lod::Pyramid& whole_;
    lod::PyramidBlock damaged_;
};

TEST(GroundPictures, ADamagedBlockInViewIsAnErrorAndNotAPicture) {
    const auto frame = geographic_frame(kColumns, kRows);
    const auto terrain = make_terrain(frame, make_heights(frame, mountains));
    const DamagedPyramid pyramid(*terrain.pyramid(), {0, 1, 1});
    const viewer::EyeHeight heights(nullptr);
    viewer::GroundData ground = ground_of(terrain);
    ground.pyramid = &pyramid;
    viewer::ViewState view;
    view.pitch.value = -90;
    viewer::set_eye(view, heights, above(terrain, 350, 350, 3000));
    const viewer::PictureRequest request{.width = 300, .height = 200, .samples = 1};
    const auto broken = viewer::draw_picture(terrain, ground, heights, view, request);
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().kind, ErrorKind::damaged);
    viewer::set_eye(view, heights, above(terrain, 900, 500, 2000));
    EXPECT_TRUE(viewer::draw_picture(terrain, ground, heights, view, request));
}

// With room for a few pages alone, large pictures are drawn in smaller parts and lose nothing.
TEST(GroundPictures, ASmallCacheDrawsTheSamePicture) {
    const auto frame = geographic_frame(kColumns, kRows);
    const auto terrain = make_terrain(frame, make_heights(frame, mountains));
    const viewer::EyeHeight heights(nullptr);
    viewer::GroundData ground = ground_of(terrain);
    viewer::ViewState view;
    view.pitch.value = -90;
    view.tau_px = 4;
    viewer::set_eye(view, heights, above(terrain, 550, 350, 22000));
    const viewer::PictureRequest request{.width = 1024, .height = 768, .samples = 1};
    const auto large = must(viewer::draw_picture(terrain, ground, heights, view, request));
    ground.cache_bytes = 17 * viewer::page_bytes(ground.facts);
    const auto small = must(viewer::draw_picture(terrain, ground, heights, view, request));
    EXPECT_GT(small.figures.draw_calls, large.figures.draw_calls);
    int different = 0;
    for (std::size_t i = 0; i < large.picture.rgb.size(); ++i)
        different += std::abs(int{large.picture.rgb[i]} - int{small.picture.rgb[i]}) > 2;
    EXPECT_LT(different, 100);  // the parts' clip spaces round vertices in other ways
}

}  // namespace
}  // namespace relevo::test
