#include "ingest/file_content.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/ingest/synthetic_raster.hpp"

namespace relevo::ingest {
namespace {

namespace fs = std::filesystem;
using Contents = std::vector<FileContent>;
using test::SyntheticRaster;

const Contents kElevation{FileContent::elevation};
const Contents kImagery{FileContent::imagery};
const Contents kVectors{FileContent::vectors};
const Contents kEither{FileContent::imagery, FileContent::elevation};

class FileContentTest : public testing::Test {
  protected:
    Contents of(const SyntheticRaster& raster) {
        return contents_of(raster.write(folder_ / fmt::format("{}.tif", ++files_)).string());
    }
    Contents of(const char* name, const char* text) {
        std::ofstream(folder_ / name) << text;
        return contents_of((folder_ / name).string());
    }

    test::SceneFolder folder_;
    int files_ = 0;
};

TEST_F(FileContentTest, OneBandOfNumbersIsElevation) {
    for (const GDALDataType type : {GDT_Int16, GDT_UInt16, GDT_Int32, GDT_Float32, GDT_Float64})
        EXPECT_EQ(of({.type = type}), kElevation) << type;
    EXPECT_EQ(of({.bands = 2, .type = GDT_Float32}), kElevation) << "with a mask, most likely";
}

TEST_F(FileContentTest, ThreeBandsOrAPaletteAreImagery) {
    EXPECT_EQ(of({.bands = 3, .type = GDT_Byte}), kImagery);
    EXPECT_EQ(of({.bands = 4, .type = GDT_Byte}), kImagery);
    EXPECT_EQ(of({.bands = 3, .type = GDT_UInt16}), kImagery) << "it then says that it wants bytes";
    const fs::path file = SyntheticRaster{.type = GDT_Byte}.write(folder_ / "palette.tif");
    {
        const GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
        GDALColorTable colours;
        const GDALColorEntry red{255, 0, 0, 255};
        colours.SetColorEntry(1, &red);
        dataset->GetRasterBand(1)->SetColorTable(&colours);
    }
    EXPECT_EQ(contents_of(file.string()), kImagery);
}

TEST_F(FileContentTest, OneBandOfBytesIsAQuestion) {
    EXPECT_EQ(of({.type = GDT_Byte}), kEither);
    EXPECT_EQ(of({.bands = 2, .type = GDT_Byte, .interpretations = {GCI_GrayIndex, GCI_AlphaBand}}), kEither);
}

TEST_F(FileContentTest, LinesAndPointsAreVectors) {
    EXPECT_EQ(
        of("track.gpx",
           "<?xml version='1.0'?><gpx version='1.1' creator='t' xmlns='http://www.topografix.com/GPX/1/1'>"
           "<trk><trkseg><trkpt lat='46' lon='8'/><trkpt lat='46.1' lon='8'/></trkseg></trk></gpx>"),
        kVectors);
    EXPECT_EQ(of("way.geojson", R"({"type":"LineString","coordinates":[[8,46],[8.1,46.2]]})"), kVectors);
    EXPECT_EQ(of("table.csv", "a,b\n1,2\n"), kElevation) << "no geometry: the import says what is wrong";
}

TEST_F(FileContentTest, WhatIsNothingIsLeftToTheImportToRefuse) {
    EXPECT_EQ(of("notes.tif", "not a picture"), kElevation);
    EXPECT_EQ(of("empty.gpx", ""), kElevation);
    EXPECT_EQ(contents_of(folder_.path().string()), kElevation);
    EXPECT_EQ(contents_of((folder_ / "nowhere.tif").string()), kElevation);
    const fs::path cut =
        SyntheticRaster{.columns = 400, .rows = 300, .bands = 3, .type = GDT_Byte}.write(folder_ / "cut.tif");
    fs::resize_file(cut, 60);
    EXPECT_EQ(contents_of(cut.string()), kElevation);
}

}  // namespace
}  // namespace relevo::ingest
