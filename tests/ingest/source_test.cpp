// What ingest refuses, and what it tells to do about it; and how values become heights.
#include "ingest/source/source.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <cpl_string.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

SourceRequest request_for(const std::filesystem::path& input) {
    SourceRequest request;
    request.input = input.string();
    return request;
}

std::string refusal_of(const SourceRequest& request) {
    const auto source = Source::open(request);
    EXPECT_FALSE(source);
    if (source) return "opened";
    EXPECT_EQ(source.error().kind, ErrorKind::input);
    return source.error().message;
}

lod::Raster<double> all_of(const SourceRequest& request) {
    const auto source = Source::open(request);
    EXPECT_TRUE(source) << (source ? "" : source.error().message);
    if (!source) return {};
    auto heights = source->read({0, 0, source->columns(), source->rows()});
    EXPECT_TRUE(heights);
    return heights ? std::move(*heights) : lod::Raster<double>{};
}

TEST(SourceRefuses, FilesThatAreNoRaster) {
    const SceneFolder folder;
    EXPECT_TRUE(test::says(refusal_of(request_for(folder / "none.tif")), {"none.tif", "no such file"}));
    test::replace(folder / "text.tif", "this is not a raster\n");
    EXPECT_TRUE(
        test::says(refusal_of(request_for(folder / "text.tif")), {"text.tif", "cannot read it as a raster"}));
    test::replace(folder / "empty.tif", "");
    EXPECT_TRUE(test::says(refusal_of(request_for(folder / "empty.tif")), {"empty.tif", "empty"}));
    EXPECT_FALSE(Source::open(request_for(folder.path())));
    EXPECT_FALSE(Source::open(request_for("")));
}

TEST(SourceRefuses, NoPermission) {
    if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const SceneFolder folder;
    const auto file = SyntheticRaster{}.write(folder / "secret.tif");
    std::filesystem::permissions(file, std::filesystem::perms::none);
    EXPECT_TRUE(test::says(refusal_of(request_for(file)), {"secret.tif", "permission"}));
}

TEST(SourceRefuses, PicturesAndSeveralBands) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Byte;
    raster.bands = 3;
    raster.creation_options = {"PHOTOMETRIC=RGB"};
    EXPECT_TRUE(test::says(refusal_of(request_for(raster.write(folder / "rgb.tif"))),
                           {"rgb.tif", "image", "--encoding terrain-rgb", "terrarium"}));
    raster.creation_options = {"PHOTOMETRIC=MINISBLACK"};
    EXPECT_TRUE(
        test::says(refusal_of(request_for(raster.write(folder / "grey.tif"))), {"grey.tif", "image"}));
    raster.type = GDT_Int16;
    EXPECT_TRUE(test::says(refusal_of(request_for(raster.write(folder / "three.tif"))),
                           {"3 bands", "--band", "\n  3  Int16"}));
    {
        auto* format = GetGDALDriverManager()->GetDriverByName("GTiff");
        const DatasetPtr dataset{
            format->Create((folder / "palette.tif").c_str(), 20, 10, 1, GDT_Byte, nullptr)};
        GDALColorTable palette;
        const GDALColorEntry red{200, 10, 10, 255};
        palette.SetColorEntry(1, &red);
        ASSERT_EQ(dataset->GetRasterBand(1)->SetColorTable(&palette), CE_None);
    }
    EXPECT_TRUE(test::says(refusal_of(request_for(folder / "palette.tif")), {"palette.tif", "image"}));
    raster.bands = 1;
    raster.creation_options = {};
    raster.type = GDT_CFloat32;
    EXPECT_TRUE(
        test::says(refusal_of(request_for(raster.write(folder / "complex.tif"))), {"complex numbers"}));
}

TEST(SourceRefuses, NoCrsUnlessGiven) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.crs = "";
    auto request = request_for(raster.write(folder / "degrees.tif"));
    EXPECT_TRUE(test::says(refusal_of(request), {"coordinate reference system", "--crs EPSG:4326"}));
    request.crs = "EPSG:4326";
    EXPECT_TRUE(Source::open(request));
    request.crs = "EPSG:nonsense";
    EXPECT_TRUE(test::says(refusal_of(request), {"degrees.tif", "EPSG:nonsense"}));

    raster.geotransform = {500000, 30, 0, 5000000, 0, -30};
    EXPECT_TRUE(
        test::says(refusal_of(request_for(raster.write(folder / "metres.tif"))), {"--crs EPSG:32611"}));
}

TEST(SourceRefuses, NoGeotransformUnlessGiven) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.georeferenced = false;
    auto request = request_for(raster.write(folder / "nowhere.tif"));
    EXPECT_TRUE(test::says(refusal_of(request), {"nowhere.tif", "--bounds"}));
    request.bounds = Bounds{10, 49.9, 10.2, 50};  // outer edges: 20 x 10 pixels of 0.01 degrees
    const auto source = Source::open(request);
    ASSERT_TRUE(source) << source.error().message;
    const Place first = source->posts().at({0, 0});
    EXPECT_NEAR(first.x, 10.005, 1e-12);
    EXPECT_NEAR(first.y, 49.995, 1e-12);
}

TEST(SourceRefuses, ControlPointsAlone) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.georeferenced = false;
    const auto file = raster.write(folder / "points.tif");
    {
        const DatasetPtr dataset{GDALDataset::Open(file.c_str(), GDAL_OF_UPDATE)};
        std::array<GDAL_GCP, 3> points{};
        GDALInitGCPs(3, points.data());
        for (int i = 0; i < 3; ++i) {
            auto& point = points[static_cast<std::size_t>(i)];
            point.dfGCPPixel = i == 1 ? 20 : 0;
            point.dfGCPLine = i == 2 ? 10 : 0;
            point.dfGCPX = 10 + 0.01 * point.dfGCPPixel;
            point.dfGCPY = 50 - 0.01 * point.dfGCPLine;
        }
        OGRSpatialReference wgs84;
        wgs84.importFromEPSG(4326);
        dataset->SetGCPs(3, points.data(), &wgs84);
        GDALDeinitGCPs(3, points.data());
    }
    EXPECT_TRUE(test::says(refusal_of(request_for(file)), {"control points", "gdalwarp"}));
}

TEST(SourceRefuses, SeveralVariables) {
    if (GDALAllRegister(); GetGDALDriverManager()->GetDriverByName("netCDF") == nullptr)
        GTEST_SKIP() << "no netCDF here";
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.bands = 2;
    raster.driver = "netCDF";
    const auto file = raster.write(folder / "two.nc");
    EXPECT_TRUE(test::says(refusal_of(request_for(file)),
                           {"two.nc", "several variables", "--variable", "two.nc:NAME", "Band1", "Band2"}));
    const auto one = Source::open(request_for("NETCDF:\"" + file.string() + "\":Band2"));
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_EQ(one->name(), "two.nc:Band2");
    EXPECT_EQ(one->file(), file);

    auto request = request_for(file.string() + ":Band2");
    const auto shorter = Source::open(request);
    ASSERT_TRUE(shorter) << shorter.error().message;
    EXPECT_EQ(shorter->name(), "two.nc:Band2");
    EXPECT_EQ(shorter->file(), file);
    request = request_for(file);
    request.variable = "Band1";
    EXPECT_TRUE(Source::open(request));
    request.variable = "Band3";
    EXPECT_TRUE(test::says(refusal_of(request), {"two.nc", "no variable 'Band3'", "Band1", "Band2"}));
}

TEST(SourceRefuses, VariablesThatAreNotThere) {
    if (GDALAllRegister(); GetGDALDriverManager()->GetDriverByName("netCDF") == nullptr)
        GTEST_SKIP() << "no netCDF here";
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.driver = "netCDF";
    auto request = request_for(raster.write(folder / "one.nc"));
    EXPECT_TRUE(Source::open(request));
    request.variable = "Band1";
    EXPECT_TRUE(Source::open(request));
    request.variable = "elevation";
    EXPECT_TRUE(test::says(refusal_of(request), {"one.nc", "no variable 'elevation'"}));
}

TEST(Source, ABandOfSeveral) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.bands = 3;
    auto request = request_for(raster.write(folder / "three.tif"));
    {
        const DatasetPtr dataset{GDALDataset::Open(request.input.c_str(), GDAL_OF_UPDATE)};
        ASSERT_EQ(dataset->GetRasterBand(2)->Fill(77), CE_None);
    }
    request.band = 2;
    EXPECT_EQ(all_of(request).at(3, 3), 77);
    request.band = 4;
    EXPECT_TRUE(test::says(refusal_of(request), {"three.tif", "no band 4", "1 to 3"}));
    request.band = 0;
    EXPECT_TRUE(test::says(refusal_of(request), {"no band 0"}));
}

TEST(Source, HeightsPackedIntoColours) {
    const SceneFolder folder;
    const int mapbox[3] = {1, 134, 160};      // 65536 + 134 * 256 + 160 = 100 000: 0 m
    const int terrarium[3] = {128, 100, 64};  // 128 * 256 + 100 + 64 / 256 = 32768 + 100.25
    for (const bool is_mapbox : {true, false}) {
        SyntheticRaster raster;
        raster.type = GDT_Byte;
        raster.bands = 3;
        raster.creation_options = {"PHOTOMETRIC=RGB"};
        auto request = request_for(raster.write(folder / "tile.tif"));
        {
            const DatasetPtr dataset{GDALDataset::Open(request.input.c_str(), GDAL_OF_UPDATE)};
            for (int i = 0; i < 3; ++i) {
                ASSERT_EQ(dataset->GetRasterBand(i + 1)->Fill(is_mapbox ? mapbox[i] : terrarium[i]), CE_None);
                std::uint8_t none = 0;
                ASSERT_EQ(dataset->GetRasterBand(i + 1)->RasterIO(GF_Write, 5, 5, 1, 1, &none, 1, 1, GDT_Byte,
                                                                  0, 0, nullptr),
                          CE_None);
            }
        }
        request.encoding = is_mapbox ? HeightEncoding::terrain_rgb : HeightEncoding::terrarium;
        const auto heights = all_of(request);
        EXPECT_EQ(heights.at(0, 0), is_mapbox ? 0 : 100.25);
        EXPECT_TRUE(std::isnan(heights.at(5, 5)));
        const auto source = Source::open(request);
        ASSERT_TRUE(source);
        EXPECT_FALSE(source->whole_metres());
    }
    auto grey = request_for(SyntheticRaster{}.write(folder / "grey.tif"));
    grey.encoding = HeightEncoding::terrain_rgb;
    EXPECT_TRUE(test::says(refusal_of(grey), {"grey.tif", "red, green and blue"}));
    SyntheticRaster raster;
    raster.columns = raster.rows = 16;
    raster.type = GDT_Byte;
    raster.bands = 3;
    raster.creation_options = {"COMPRESS=JPEG", "PHOTOMETRIC=YCBCR"};
    auto lossy = request_for(raster.write(folder / "lossy.tif"));
    lossy.encoding = HeightEncoding::terrarium;
    EXPECT_TRUE(test::says(refusal_of(lossy), {"lossy.tif", "loss"}));
}

TEST(Source, CutFilesAreToldFromWholeOnes) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.columns = raster.rows = 200;
    raster.value = [](int column, int row) { return (column * 7919 + row * 104729) % 1000; };
    const auto whole = test::contents(raster.write(folder / "whole.tif"));
    const auto heights = all_of(request_for(folder / "whole.tif"));
    for (const double part : {0.01, 0.2, 0.5, 0.9}) {
        test::replace(folder / "cut.tif",
                      whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
        const auto source = Source::open(request_for(folder / "cut.tif"));
        if (!source) {
            EXPECT_EQ(source.error().kind, ErrorKind::input);
            continue;
        }
        const auto read = source->read({0, 0, 200, 200});
        ASSERT_FALSE(read) << part;
        EXPECT_EQ(read.error().kind, ErrorKind::input);
        EXPECT_TRUE(test::says(read.error().message, {"cut.tif", "cut short"}));
    }
}

TEST(Source, ArchiveWithOneRaster) {
    const SceneFolder folder;
    SyntheticRaster raster;
    const auto inside = raster.write(folder / "inside.tif");
    const auto zip = (folder / "tiles.zip").string();
    const auto add = [&](const char* name) {
        const auto bytes = test::contents(inside);
        VSILFILE* out = VSIFOpenL(("/vsizip/" + zip + "/" + name).c_str(), "wb");
        ASSERT_NE(out, nullptr);
        VSIFWriteL(bytes.data(), 1, bytes.size(), out);
        VSIFCloseL(out);
    };
    add("folder/one.tif");
    const auto heights = all_of(request_for(zip));
    EXPECT_EQ(heights.samples(), all_of(request_for(inside)).samples());
    add("two.tif");
    EXPECT_TRUE(
        test::says(refusal_of(request_for(zip)), {"tiles.zip", "several rasters", "one.tif", "two.tif"}));
}

TEST(Source, EveryKindOfVoid) {
    const SceneFolder folder;
    const double infinity = std::numeric_limits<double>::infinity();
    const double values[] = {1, -9999, std::nan(""), infinity, -infinity, 3.4028234663852886e38, 7};
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = 7;
    raster.rows = 2;
    raster.value = [&](int column, int) { return values[column]; };
    raster.nodata = -9999;
    const auto check = [&](const SourceRequest& request, std::initializer_list<int> valid) {
        const auto heights = all_of(request);
        for (int c = 0; c < 7; ++c)
            EXPECT_EQ(!std::isnan(heights.at(c, 1)), std::find(valid.begin(), valid.end(), c) != valid.end())
                << c;
    };
    auto request = request_for(raster.write(folder / "voids.tif"));
    check(request, {0, 5, 6});
    request.nodata = 3.4028235e38;  // as people write it: too few digits for the float's own value
    check(request, {0, 1, 6});
    request.nodata = 7;
    check(request, {0, 1, 5});
}

TEST(Source, ValidMinus32768IsAHeight) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.value = [](int column, int) { return column == 3 ? -32768 : 0; };
    EXPECT_EQ(all_of(request_for(raster.write(folder / "deep.tif"))).at(3, 0), -32768);
    raster.nodata = -32768;
    EXPECT_TRUE(std::isnan(all_of(request_for(raster.write(folder / "void.tif"))).at(3, 0)));
}

TEST(Source, MaskBandsAreVoids) {
    const SceneFolder folder;
    const auto file = SyntheticRaster{}.write(folder / "masked.tif");
    {
        const DatasetPtr dataset{GDALDataset::Open(file.c_str(), GDAL_OF_UPDATE)};
        dataset->CreateMaskBand(GMF_PER_DATASET);
        std::vector<std::uint8_t> mask(200, 255);
        mask[5] = 0;
        ASSERT_EQ(dataset->GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 20, 10, mask.data(), 20,
                                                                     10, GDT_Byte, 0, 0, nullptr),
                  CE_None);
    }
    const auto heights = all_of(request_for(file));
    EXPECT_TRUE(std::isnan(heights.at(5, 0)));
    EXPECT_EQ(heights.at(6, 0), 118);
}

TEST(Source, FeetScaleAndOffset) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.unit = "US survey foot";
    raster.scale = 0.5;
    raster.offset = 20;
    auto request = request_for(raster.write(folder / "feet.tif"));
    EXPECT_NEAR(all_of(request).at(4, 3), (106 * 0.5 + 20) * 1200 / 3937, 1e-9);
    request.height_scale = 2;
    request.height_offset = 1;
    EXPECT_NEAR(all_of(request).at(4, 3), (106 * 0.5 + 20) * 2 + 1, 1e-9);
}

TEST(Source, WindowsBeyondTheRasterAreVoidThere) {
    const SceneFolder folder;
    const auto source = Source::open(request_for(SyntheticRaster{}.write(folder / "a.tif")));
    ASSERT_TRUE(source);
    const auto heights = source->read({-2, -1, 30, 14});
    ASSERT_TRUE(heights);
    for (int r = 0; r < 14; ++r)
        for (int c = 0; c < 30; ++c) {
            const bool inside = c >= 2 && c < 22 && r >= 1 && r < 11;
            ASSERT_EQ(std::isnan(heights->at(c, r)), !inside);
            if (inside) {
                ASSERT_EQ(heights->at(c, r), 100 + 3 * (c - 2) - 2 * (r - 1));
            }
        }
}

// GDAL moves the origin by half a pixel for pixel-is-point files, unless an option is set in the environment.
TEST(Source, PixelIsPointWhateverTheEnvironmentSays) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.area_or_point = "Point";
    const auto file = raster.write(folder / "point.tif");
    CPLSetConfigOption("GTIFF_POINT_GEO_IGNORE", "YES");
    const auto source = Source::open(request_for(file));
    CPLSetConfigOption("GTIFF_POINT_GEO_IGNORE", nullptr);
    ASSERT_TRUE(source);
    EXPECT_NEAR(source->posts().x0, 10.005, 1e-12);
    EXPECT_NEAR(source->posts().y0, 49.995, 1e-12);
}

}  // namespace
}  // namespace relevo::ingest
