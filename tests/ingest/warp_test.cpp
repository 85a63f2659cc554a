// The fast ways of making posts against the plain ones.
#include "ingest/resample/warp.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "ingest/mosaic/extent_index.hpp"
#include "ingest/mosaic/lattice.hpp"
#include "ingest/mosaic/longitudes.hpp"
#include "tests/ingest/synthetic_raster.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

/// One file as a layer.
struct OneLayer {
    Result<SourcePool> pool;
    std::vector<Layer> layers;

    explicit OneLayer(const std::filesystem::path& file) : pool(Error{}) {
        SourceRequest request;
        request.input = file.string();
        pool = SourcePool::open({request});
        EXPECT_TRUE(pool);
        auto made = make_layers(*pool, false);
        EXPECT_TRUE(made);
        layers = std::move(*made);
    }
};

// Rows that share their weights give what resample gives post by post, bit for bit, voids and edges included.
TEST(Warp, SeparableMapsGiveTheSameBits) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = 70;
    raster.rows = 50;
    raster.nodata = -9999;
    std::mt19937 random{7};
    raster.value = [&](int, int) {
        return random() % 23 == 0 ? -9999.0 : static_cast<double>(random() % 9000) / 7;
    };
    for (const double south_up : {-1.0, 1.0}) {
        raster.geotransform = {10, 0.01, 0, 50, 0, south_up * 0.01};
        const OneLayer one{raster.write(folder / "rough.tif")};
        const Layer& layer = one.layers.at(0);
        for (const double step : {0.0023, 0.0101, 0.034}) {
            geo::GridFrame frame;
            frame.west = 9.98;
            frame.north = 50.02 + (south_up > 0 ? 0.5 : 0);
            frame.step_x = step;
            frame.step_y = 1.1 * step;
            frame.columns = static_cast<int>(0.75 / step);
            frame.rows = static_cast<int>(0.55 / step);
            const GridMap map{layer.map(), frame};
            const Warp warp{layer, map, Resampling::cubic};
            const Window all{0, 0, frame.columns, frame.rows};
            const auto posts = warp.read(all, std::vector<bool>(1000, true));
            ASSERT_TRUE(posts);
            const auto part = layer.read({-8, -8, 90, 70});
            ASSERT_TRUE(part);
            const auto places = transform_posts([&](std::span<Place> p) { map.to_source(p); }, all);
            int valid = 0;
            for (int r = 0; r < frame.rows; ++r)
                for (int c = 0; c < frame.columns; ++c) {
                    const float plain = layer.holds(places.at(c, r))
                                            ? static_cast<float>(resample(part->posts, places.at(c, r),
                                                                          Resampling::cubic, {}))
                                            : std::nanf("");
                    const float fast = posts->heights.at(c, r);
                    ASSERT_TRUE(fast == plain || (std::isnan(fast) && std::isnan(plain)))
                        << step << " " << c << " " << r << ": " << fast << " " << plain;
                    valid += std::isnan(fast) ? 0 : 1;
                }
            EXPECT_GT(valid, frame.columns * frame.rows / 2);
        }
    }
}

// A scene post may be the mean of more posts than are read at once for one part: parts are halved. Truth: the
// mean of an area, summed here.
TEST(Warp, MeansOfLargeAreas) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = raster.rows = 4000;
    raster.geotransform = {10, 0.0001, 0, 50, 0, -0.0001};
    raster.value = [](int c, int r) { return c % 100 + r; };
    const OneLayer one{raster.write(folder / "large.tif")};
    geo::GridFrame frame;
    frame.step_x = frame.step_y = 0.01;  // 100 posts
    frame.west = 10 + 0.005;             // the middle of posts 0 to 99
    frame.north = 50 - 0.005;
    frame.columns = frame.rows = 40;
    const Warp warp{one.layers.at(0), GridMap{one.layers.at(0).map(), frame}, Resampling::average};
    const auto posts = warp.read({0, 0, 40, 40}, {true});
    ASSERT_TRUE(posts);
    for (int r = 0; r < 40; ++r)
        for (int c = 0; c < 40; ++c)
            ASSERT_NEAR(static_cast<double>(posts->heights.at(c, r)), 49.5 + 100 * r + 49.5, 0.01)
                << c << " " << r;
}

TEST(ExtentIndex, FindsWhatLookingAtAllFinds) {
    std::mt19937 random{11};
    const auto number = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
    for (int round = 0; round < 20; ++round) {
        std::vector<Window> windows;
        for (int i = 0; i < 1 + number(200); ++i)
            windows.push_back(
                {number(5000) - 1000, number(3000), 1 + number(round % 2 == 0 ? 20 : 900), 1 + number(50)});
        const ExtentIndex index{windows};
        for (int k = 0; k < 200; ++k) {
            const Window w{number(6000) - 1500, number(4000) - 500, 1 + number(800), 1 + number(800)};
            std::vector<int> truth;
            for (std::size_t i = 0; i < windows.size(); ++i) {
                const Window& v = windows[i];
                if (v.column < w.column + w.columns && w.column < v.column + v.columns &&
                    v.row < w.row + w.rows && w.row < v.row + v.rows)
                    truth.push_back(static_cast<int>(i));
            }
            ASSERT_EQ(index.meeting(w), truth);
        }
    }
    EXPECT_TRUE(ExtentIndex{}.meeting({0, 0, 10, 10}).empty());
}

TEST(Lattice, OffsetsOfWholeStepsWithinAThousandth) {
    Affine lattice;
    lattice.x0 = 10;
    lattice.x_column = 0.01;
    lattice.y0 = 50;
    lattice.y_row = -0.01;
    Affine posts = lattice;
    posts.x0 += 12 * 0.01;
    posts.y0 -= -7 * 0.01;
    const auto window = window_in(lattice, posts, 100, 80);
    ASSERT_TRUE(window);
    EXPECT_EQ(window->column, 12);
    EXPECT_EQ(window->row, -7);
    Affine off = posts;
    off.x0 += 0.0005 * 0.01;
    EXPECT_TRUE(window_in(lattice, off, 100, 80));
    off.x0 += 0.001 * 0.01;
    EXPECT_FALSE(window_in(lattice, off, 100, 80));
    Affine longer = posts;
    longer.x_column *= 1 + 1e-5;
    EXPECT_TRUE(window_in(lattice, longer, 50, 80));
    EXPECT_FALSE(window_in(lattice, longer, 200, 80));  // 0.002 of a post off at its end
    Affine turned = posts;
    turned.y_column = 1e-4 * 0.01;
    EXPECT_FALSE(window_in(lattice, turned, 100, 80));
}

TEST(Longitudes, StartAfterTheLargestGap) {
    EXPECT_EQ(start_after_largest_gap({{10, 20}}, 360), 10);
    EXPECT_EQ(start_after_largest_gap({{179, 180}, {-180, -179}}, 360), 179);
    EXPECT_EQ(start_after_largest_gap({{-180, -179}, {179, 180}, {539, 540}}, 360), 179);
    EXPECT_EQ(start_after_largest_gap({{0, 100}, {100, 200}, {250, 300}}, 360), 0);
    EXPECT_EQ(start_after_largest_gap({{0, 100}, {100, 200}, {290, 340}}, 360), 290);
    EXPECT_EQ(start_after_largest_gap({{350, 380}, {100, 200}}, 360), 350);
}

}  // namespace
}  // namespace relevo::ingest
