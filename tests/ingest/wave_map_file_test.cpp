#include "ingest/wave_map_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/ingest/synthetic_raster.hpp"

namespace relevo::test {
namespace {

using ingest::read_wave_map;

class WaveMapFile : public testing::Test {
  protected:
    std::string write(const SyntheticRaster& raster, const std::string& name = "swell.tif") const {
        return raster.write(folder_ / name).string();
    }

    /// Refused with a message that has all of these.
    static void expect_refusal(const std::string& file, double range_m,
                               const std::vector<std::string>& words) {
        const auto read = read_wave_map(file, range_m);
        ASSERT_FALSE(read) << file;
        EXPECT_EQ(read.error().kind, ErrorKind::input);
        for (const auto& word : words)
            EXPECT_NE(read.error().message.find(word), std::string::npos) << read.error().message;
    }

    /// Heights of whole waves a tile. \param x, y  a tile to 1, y to the south
    static double swell(double x, double y) {
        constexpr double kTurn = 2 * std::numbers::pi;
        return std::cos(kTurn * (3 * x + 2 * y) + 1) + 0.5 * std::sin(kTurn * (x - 5 * y));
    }
    static SyntheticRaster swell_raster(int columns, int rows) {
        SyntheticRaster raster;
        raster.columns = columns;
        raster.rows = rows;
        raster.georeferenced = false;
        raster.crs = "";
        raster.type = GDT_Float32;
        raster.value = [=](int column, int row) {
            return 10 + swell((column + 0.5) / columns, (row + 0.5) / rows);
        };
        return raster;
    }
    static double worst_of_swell(const ingest::WaveMapPosts& posts) {
        double worst = 0;
        for (int row = 0; row < posts.side; ++row) {
            for (int column = 0; column < posts.side; ++column) {
                const double truth = 10 + swell((column + 0.5) / posts.side, 1 - (row + 0.5) / posts.side);
                const auto at = static_cast<std::size_t>(row * posts.side + column);
                worst = std::max(worst, std::abs(static_cast<double>(posts.heights_m[at]) - truth));
            }
        }
        return worst;
    }

    SceneFolder folder_;
};

TEST_F(WaveMapFile, OfAPowerOfTwoIsTakenAsItIs) {
    const auto read = read_wave_map(write(swell_raster(64, 64)), 0);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->side, 64);
    EXPECT_LT(worst_of_swell(*read), 1e-5) << "south first";
}

TEST_F(WaveMapFile, OfAnySizeIsResampled) {
    struct Case {
        int columns, rows, side;
        double worst;
    };
    // Of means over two or three posts waves are lower, by (pi a wave's part of a post)^2 / 6.
    for (const auto& [columns, rows, side, worst] : {Case{100, 100, 128, 2e-4},
                                                     {64, 100, 128, 2e-3},
                                                     {300, 200, 256, 2e-3},
                                                     {1500, 700, 1024, 2e-4},
                                                     {91, 40, 128, 2e-3},
                                                     {90, 90, 64, 0.02}}) {
        const auto read = read_wave_map(write(swell_raster(columns, rows)), 0);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->side, side) << columns << " x " << rows;
        EXPECT_EQ(read->columns, columns);
        EXPECT_EQ(read->rows, rows);
        EXPECT_LT(worst_of_swell(*read), worst) << columns << " x " << rows;
    }
}

TEST_F(WaveMapFile, LongCrestsMayBeALine) {
    auto line = swell_raster(64, 1);
    line.value = [](int column, int) { return column % 16; };
    const auto read = read_wave_map(write(line), 0);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->side, 64);
    for (std::size_t i = 0; i < read->heights_m.size(); ++i)
        EXPECT_NEAR(static_cast<double>(read->heights_m[i]), static_cast<double>(i % 16), 1e-5);
}

TEST_F(WaveMapFile, HeightsAreInMetres) {
    SyntheticRaster raster = swell_raster(8, 8);
    raster.type = GDT_Int16;
    raster.value = [](int column, int row) { return 100 * column + row; };
    raster.scale = 0.01;
    raster.offset = 2;
    auto read = read_wave_map(write(raster), 0);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_NEAR(static_cast<double>(read->heights_m[63]), 9, 1e-5);  // the north-east
    raster.unit = "ft";
    read = read_wave_map(write(raster), 0);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_NEAR(static_cast<double>(read->heights_m[63]), 9 * 0.3048, 1e-5);
    read = read_wave_map(write(raster), 5);
    ASSERT_TRUE(read) << read.error().message;
    const auto [low, high] = std::minmax_element(read->heights_m.begin(), read->heights_m.end());
    EXPECT_NEAR(static_cast<double>(*high - *low), 5, 1e-5) << "what is asked for goes before";
}

TEST_F(WaveMapFile, ShadesOfGreyNeedARange) {
    SyntheticRaster raster = swell_raster(16, 16);
    for (const auto type : {GDT_Byte, GDT_UInt16, GDT_Int16}) {
        raster.type = type;
        raster.value = [](int column, int row) { return 3 * column + 5 * row; };
        const auto file = write(raster);
        expect_refusal(file, 0, {"swell.tif", "shades of grey", "HEIGHT_M"});
        const auto read = read_wave_map(file, 2.4);
        ASSERT_TRUE(read) << read.error().message;
        const auto [low, high] = std::minmax_element(read->heights_m.begin(), read->heights_m.end());
        EXPECT_NEAR(static_cast<double>(*high - *low), 2.4, 1e-5);
    }
}

TEST_F(WaveMapFile, ReadsPictures) {
    // PNG cannot be created but copied: by way of a TIFF.
    SyntheticRaster raster = swell_raster(16, 16);
    raster.type = GDT_UInt16;
    raster.value = [](int column, int row) { return 1000 * column + row; };
    const auto tiff = write(raster);
    const auto png = (folder_ / "swell.png").string();
    GDALDatasetH from = GDALOpen(tiff.c_str(), GA_ReadOnly);
    GDALClose(GDALCreateCopy(GDALGetDriverByName("PNG"), png.c_str(), from, 0, nullptr, nullptr, nullptr));
    GDALClose(from);
    expect_refusal(png, 0, {"swell.png", "HEIGHT_M"});
    const auto read = read_wave_map(png, 15.015);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_NEAR(static_cast<double>(read->heights_m[15] - read->heights_m[0]), 15, 1e-4);
}

TEST_F(WaveMapFile, WhatIsNoMapIsRefused) {
    expect_refusal((folder_ / "none.png").string(), 0, {"none.png", "no such file"});
    std::ofstream(folder_ / "text.png") << "not a picture";
    expect_refusal((folder_ / "text.png").string(), 0, {"text.png", "cannot read"});
    std::ofstream(folder_ / "empty.png");
    expect_refusal((folder_ / "empty.png").string(), 0, {"empty.png", "empty"});

    SyntheticRaster raster = swell_raster(16, 16);
    raster.bands = 3;
    expect_refusal(write(raster), 0, {"swell.tif", "3 bands", "gdal_translate -b 1"});
    raster.bands = 2;
    raster.interpretations = {GCI_GrayIndex, GCI_AlphaBand};
    raster.type = GDT_Byte;
    raster.value = [](int column, int row) { return 1 + 10 * column + row; };
    EXPECT_TRUE(read_wave_map(write(raster), 1)) << "an alpha band may be there";
    raster.value = [](int column, int row) { return column + row; };  // alpha too: 0 in a corner
    expect_refusal(write(raster), 1, {"1 of its 256 posts", "gdal_fillnodata"});
}

TEST_F(WaveMapFile, HolesAreRefused) {
    SyntheticRaster raster = swell_raster(16, 16);
    raster.value = [](int column, int row) {
        return column == 3 && row == 5 ? std::numeric_limits<double>::quiet_NaN() : column;
    };
    expect_refusal(write(raster), 0, {"1 of its 256 posts"});
    raster.value = [](int column, int row) { return column == 3 && row > 5 ? -9999 : column; };
    raster.nodata = -9999;
    expect_refusal(write(raster), 0, {"10 of its 256 posts"});
    raster.value = [](int column, int) { return column; };
    EXPECT_TRUE(read_wave_map(write(raster), 0)) << "a nodata value that is not there";
}

TEST_F(WaveMapFile, ConstantHugeAndOddHeightsAreRefused) {
    SyntheticRaster raster = swell_raster(16, 16);
    raster.value = [](int, int) { return 3.25; };
    expect_refusal(write(raster), 0, {"all its heights are the same", "--wind 0"});
    expect_refusal(write(raster), 2, {"all its heights are the same"});
    raster.value = [](int column, int) { return 100 * column; };
    expect_refusal(write(raster), 0, {"1500 m", "HEIGHT_M"});
    EXPECT_TRUE(read_wave_map(write(raster), 2));
    raster.unit = "kelvin";
    raster.value = [](int column, int) { return column; };
    expect_refusal(write(raster), 0, {"kelvin"});
    EXPECT_TRUE(read_wave_map(write(raster), 2));
    SyntheticRaster large = swell_raster(5000, 2);
    expect_refusal(write(large), 0, {"5000 x 2", "gdal_translate -outsize"});
    raster.type = GDT_CFloat32;
    expect_refusal(write(raster), 0, {"complex"});
}

TEST_F(WaveMapFile, CutShortIsRefused) {
    const auto file = write(swell_raster(256, 256));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    expect_refusal(file, 0, {"swell.tif"});
}

}  // namespace
}  // namespace relevo::test
