// Hard case 2 and 3 as ingest meets them: odd values, odd shapes.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::imported;
using test::options_for;
using test::refused;
using test::SceneFolder;
using test::SyntheticRaster;

SyntheticRaster utm(int columns, int rows) {
    SyntheticRaster raster;
    raster.crs = "EPSG:32632";
    raster.geotransform = {700000, 30, 0, 5200000, 0, -30};
    raster.columns = columns;
    raster.rows = rows;
    raster.type = GDT_Float32;
    raster.nodata = -9999;
    return raster;
}

TEST(Values, AllVoidIsRefused) {
    const SceneFolder folder;
    for (const bool projected : {false, true}) {
        SyntheticRaster raster = projected ? utm(30, 20) : SyntheticRaster{};
        raster.type = GDT_Float32;
        raster.nodata = -9999;
        raster.value = [](int c, int) { return c % 2 == 0 ? -9999 : std::nan(""); };
        EXPECT_TRUE(test::says(refused(folder, options_for(raster.write(folder / "void.tif"))),
                               {"void.tif", "void", "--nodata"}));
    }
}

TEST(Values, ASingleValidPostStays) {
    const SceneFolder folder;
    for (const bool projected : {false, true}) {
        SyntheticRaster raster = projected ? utm(30, 20) : SyntheticRaster{};
        raster.nodata = -9999;
        raster.value = [](int c, int r) { return c == 7 && r == 5 ? 123 : -9999; };
        const auto scene = imported(folder, options_for(raster.write(folder / "one.tif")));
        EXPECT_GE(scene.info.valid_posts, 1U) << projected;
        EXPECT_LE(scene.info.valid_posts, 4U) << projected;
        EXPECT_EQ(scene.info.height_min_m, 123);
        EXPECT_EQ(scene.info.height_max_m, 123);
    }
}

TEST(Values, FlatStaysFlatAndASpikeStaysASpike) {
    const SceneFolder folder;
    SyntheticRaster flat = utm(100, 80);
    flat.value = [](int, int) { return 1277.25; };
    const auto plain = imported(folder, options_for(flat.write(folder / "flat.tif")));
    EXPECT_EQ(plain.info.height_min_m, 1277.25);
    EXPECT_EQ(plain.info.height_max_m, 1277.25);
    EXPECT_LE(plain.info.resampling.max_m, 1e-9);
    EXPECT_EQ(plain.info.bilinear_mesh_max_m, 0);

    SyntheticRaster spike = utm(100, 80);
    spike.value = [](int c, int r) { return c == 50 && r == 40 ? 8000 : 10; };
    const auto scene = imported(folder, options_for(spike.write(folder / "spike.tif")));
    EXPECT_EQ(scene.info.height_min_m, 10);  // cubic convolution alone would dig a moat of -600 m around it
    EXPECT_LE(scene.info.height_max_m, 8000);
    EXPECT_GT(scene.info.height_max_m, 4000);
}

TEST(Values, CheckerboardStaysInItsRange) {
    const SceneFolder folder;
    SyntheticRaster raster = utm(64, 64);
    raster.value = [](int c, int r) { return (c + r) % 2 == 0 ? 0 : 100; };
    const auto scene = imported(folder, options_for(raster.write(folder / "noise.tif")));
    EXPECT_GE(scene.info.height_min_m, 0);
    EXPECT_LE(scene.info.height_max_m, 100);
}

TEST(Values, InfinitiesAndNanAreVoid) {
    const SceneFolder folder;
    SyntheticRaster raster = utm(30, 20);
    raster.value = [](int c, int r) {
        if (c == 10 && r == 10) return std::numeric_limits<double>::infinity();
        if (c == 20 && r == 10) return std::nan("");
        return 50.0;
    };
    const auto scene = imported(folder, options_for(raster.write(folder / "nan.tif")));
    EXPECT_EQ(scene.info.height_min_m, 50);
    EXPECT_EQ(scene.info.height_max_m, 50);
}

TEST(Shapes, SmallAndLong) {
    struct Shape {
        int columns, rows;
    };
    for (const Shape s :
         {Shape{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3, 3}, {17, 17}, {18, 17}, {1500, 3}, {3, 1500}})
        for (const bool projected : {false, true}) {
            const SceneFolder folder;
            SyntheticRaster raster = projected ? utm(s.columns, s.rows) : SyntheticRaster{};
            raster.columns = s.columns;
            raster.rows = s.rows;
            raster.value = [](int c, int r) { return 10 + c + r; };
            const auto scene = imported(folder, options_for(raster.write(folder / "shape.tif")));
            const auto name = fmt::format("{} x {} {}", s.columns, s.rows, projected);
            if (projected) {
                EXPECT_GE(scene.heights.columns(), s.columns) << name;
                EXPECT_GE(scene.heights.rows(), s.rows) << name;
            } else {
                EXPECT_EQ(scene.heights.columns(), s.columns) << name;
                EXPECT_EQ(scene.heights.rows(), s.rows) << name;
            }
            EXPECT_GE(scene.info.valid_posts, static_cast<std::uint64_t>(std::max(s.columns, s.rows)))
                << name;
            EXPECT_GE(scene.info.height_min_m, 10) << name;
            EXPECT_LE(scene.info.height_max_m, 10 + s.columns + s.rows - 2) << name;
        }
}

}  // namespace
}  // namespace relevo::ingest
