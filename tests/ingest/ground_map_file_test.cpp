#include "ingest/ground_map_file.hpp"

#include <array>
#include <functional>
#include <optional>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

using Shares = std::array<std::uint8_t, 4>;

/// A file of weights to be written: 40 x 40 pixels over the middle of Europe.
struct Weights {
    int bands = 4;
    GDALDataType type = GDT_Byte;
    int crs = 4326;  // 0: none
    bool placed = true;
    std::array<double, 6> place{10, 0.01, 0, 50, 0, -0.01};
    std::function<int(int column, int row, int band)> value = [](int column, int, int band) {
        return band == (column < 20 ? 0 : 3) ? 200 : 0;  // grass in the west, snow in the east
    };
    bool rgba = false;
    std::optional<double> nodata;

    std::string write(const std::filesystem::path& file) const {
        GDALAllRegister();
        constexpr int kSide = 40;
        auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        CPLStringList options;
        if (rgba) options.AddString("PHOTOMETRIC=RGB");  // of which the fourth is alpha
        const GDALDatasetUniquePtr made(
            driver->Create(file.c_str(), kSide, kSide, bands, type, options.List()));
        if (placed) {
            auto affine = place;
            made->SetGeoTransform(affine.data());
        }
        if (crs != 0) {
            OGRSpatialReference reference;
            reference.importFromEPSG(crs);
            made->SetSpatialRef(&reference);
        }
        for (int band = 0; band < bands; ++band) {
            if (nodata) made->GetRasterBand(band + 1)->SetNoDataValue(*nodata);
            for (int row = 0; row < kSide; ++row) {
                for (int column = 0; column < kSide; ++column) {
                    int number = value(column, row, band);
                    EXPECT_EQ(made->GetRasterBand(band + 1)->RasterIO(GF_Write, column, row, 1, 1, &number, 1,
                                                                      1, GDT_Int32, 0, 0, nullptr),
                              CE_None);
                }
            }
        }
        return file.string();
    }
};

/// Posts in the middles of the file's pixels.
geo::GridFrame same_grid() {
    return {geo::FrameKind::geographic, 10.005, 49.995, 0.01, 0.01, 40, 40};
}

class GroundMapFile : public testing::Test {
  protected:
    ingest::GroundMapTexels read(const Weights& weights, const geo::GridFrame& frame) const {
        auto map = ingest::read_ground_map(weights.write(folder_ / "cover.tif"), frame);
        EXPECT_TRUE(map) << map.error().message;
        return map ? *std::move(map) : ingest::GroundMapTexels{};
    }
    Shares at(const ingest::GroundMapTexels& map, int column, int row) const {
        return map.shares.at(static_cast<std::size_t>(row * map.columns + column));
    }
    std::string refused(const Weights& weights, const geo::GridFrame& frame = same_grid()) const {
        const auto map = ingest::read_ground_map(weights.write(folder_ / "cover.tif"), frame);
        EXPECT_FALSE(map);
        if (map) return {};
        EXPECT_EQ(map.error().kind, ErrorKind::input);
        return map.error().message;
    }

    SceneFolder folder_;
};

constexpr Shares kGrass{255, 0, 0, 0}, kSnow{0, 0, 0, 255}, kNothing{0, 0, 0, 0};

TEST_F(GroundMapFile, OnTheScenesGridPixelsArePosts) {
    for (const bool rgba : {false, true}) {
        Weights weights;
        weights.rgba = rgba;
        const auto map = read(weights, same_grid());
        ASSERT_EQ(map.columns, 40);
        ASSERT_EQ(map.rows, 40);
        for (int row = 0; row < 40; ++row) {
            for (int column = 0; column < 40; ++column)
                EXPECT_EQ(at(map, column, row), column < 20 ? kGrass : kSnow) << column << " " << row;
        }
    }
}

TEST_F(GroundMapFile, WeightsAreSharesThatMakeAWhole) {
    Weights weights;
    weights.value = [](int, int, int band) { return band == 3 ? 0 : 7; };
    const auto shares = at(read(weights, same_grid()), 5, 5);
    EXPECT_EQ(shares[0] + shares[1] + shares[2], 255);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(shares[i], 85, 1);
    EXPECT_EQ(shares[3], 0);
}

TEST_F(GroundMapFile, OutsideAndWhereItHasNoDataItSaysNothing) {
    Weights weights;
    weights.value = [](int, int row, int band) { return row < 10 ? 0 : band == 1 ? 255 : 0; };
    auto frame = same_grid();
    frame.columns = 60;  // 20 to the east of the file
    const auto map = read(weights, frame);
    EXPECT_EQ(at(map, 10, 5), kNothing);
    EXPECT_EQ(at(map, 10, 20), (Shares{0, 255, 0, 0}));
    EXPECT_EQ(at(map, 50, 20), kNothing);
    weights.nodata = 9;
    weights.value = [](int, int row, int band) { return row < 10 ? 9 : band == 1 ? 255 : 0; };
    EXPECT_EQ(at(read(weights, same_grid()), 10, 5), kNothing);
    EXPECT_EQ(at(read(weights, same_grid()), 10, 20), (Shares{0, 255, 0, 0}));
}

// UTM zone 33 north, whose central meridian is at 15 degrees: the border at easting 500 km runs along it.
TEST_F(GroundMapFile, AnotherCrsIsWarped) {
    Weights weights;
    weights.crs = 32633;
    weights.place = {500000 - 20 * 1000.0, 1000, 0, 5560000, 0, -1000};
    const geo::GridFrame frame{geo::FrameKind::geographic, 14.9, 50.1, 0.002, 0.002, 101, 51};
    const auto map = read(weights, frame);
    for (const int row : {0, 25, 50}) {
        EXPECT_EQ(at(map, 42, row), kGrass) << row;
        EXPECT_EQ(at(map, 58, row), kSnow) << row;
    }
}

TEST_F(GroundMapFile, AroundThePoleAndAcrossTheAntimeridianItIsFound) {
    Weights weights;
    weights.place = {-180, 9, 0, 90, 0, -0.5};  // all longitudes, from 70 degrees on
    weights.value = [](int column, int, int band) { return band == (column < 20 ? 0 : 3) ? 200 : 0; };
    const geo::GridFrame pole{geo::FrameKind::ups_north, 1.9e6, 2.1e6, 2000, 2000, 101, 101};
    const auto north = read(weights, pole);
    EXPECT_EQ(at(north, 20, 50), kGrass);  // to the west of Greenwich
    EXPECT_EQ(at(north, 80, 50), kSnow);
    weights.place = {-180, 9, 0, 20, 0, -1};
    const auto across = read(weights, {geo::FrameKind::geographic, 170, 10, 0.2, 0.2, 101, 11});
    EXPECT_EQ(at(across, 10, 5), kSnow);   // 172 east
    EXPECT_EQ(at(across, 90, 5), kGrass);  // 188 east
}

TEST_F(GroundMapFile, LargeGridsHaveFewerTexelsThanPosts) {
    const auto map = read({}, {geo::FrameKind::geographic, 10.005, 49.995, 0.39 / 5000, 0.01, 5001, 40});
    EXPECT_EQ(map.columns, ingest::kMostGroundMapSide);
    EXPECT_EQ(map.rows, 40);
    EXPECT_EQ(at(map, 1000, 20), kGrass);
    EXPECT_EQ(at(map, 3000, 20), kSnow);
}

TEST_F(GroundMapFile, WhatIsNoMapIsRefusedWithAReason) {
    Weights three;
    three.bands = 3;
    EXPECT_NE(refused(three).find("it has 3 bands, and a ground map has 4"), std::string::npos);
    Weights one;
    one.bands = 1;
    EXPECT_NE(refused(one).find("it has 1 band,"), std::string::npos);
    Weights wide;
    wide.type = GDT_UInt16;
    EXPECT_NE(refused(wide).find("UInt16"), std::string::npos);
    Weights loose;
    loose.placed = false;
    loose.crs = 0;
    EXPECT_NE(refused(loose).find("no georeference"), std::string::npos);
    Weights nowhere;
    nowhere.crs = 0;
    EXPECT_NE(refused(nowhere).find("no coordinate reference system"), std::string::npos);
    auto far = same_grid();
    far.west = -100;
    EXPECT_NE(refused({}, far).find("no weights anywhere in the scene"), std::string::npos);
    Weights empty;
    empty.value = [](int, int, int) { return 0; };
    EXPECT_NE(refused(empty).find("no weights anywhere"), std::string::npos);
    EXPECT_FALSE(ingest::read_ground_map((folder_ / "none.tif").string(), same_grid()));
}

}  // namespace
}  // namespace relevo::test
