// What an input may reach: no network, no files beside what was named, no sizes that cannot be.
#include "ingest/source/trust.hpp"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "ingest/source/source.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

namespace fs = std::filesystem;
using test::SceneFolder;
using test::SyntheticRaster;

std::string result_of(const SourceRequest& request) {
    const auto source = Source::open(request);
    if (!source) return source.error().message;
    const auto heights = source->read({0, 0, 2, 2});
    return heights ? "read" : heights.error().message;
}

std::string result_of(const fs::path& input, Trust trust = {}) {
    SourceRequest request;
    request.input = input.string();
    request.trust = std::move(trust);
    return result_of(request);
}

std::string vrt_of(const std::string& source, bool relative = true, const std::string& more = "") {
    return fmt::format(
        R"(<VRTDataset rasterXSize="20" rasterYSize="10"><SRS>EPSG:4326</SRS>)"
        R"(<GeoTransform>10,0.01,0,50,0,-0.01</GeoTransform><VRTRasterBand dataType="Int16" band="1">{}<SimpleSource>)"
        R"(<SourceFilename relativeToVRT="{}">{}</SourceFilename><SourceBand>1</SourceBand></SimpleSource>)"
        R"(</VRTRasterBand></VRTDataset>)",
        more, relative ? 1 : 0, source);
}

/// home/ with the VRT, home/below/in.tif, outside/out.tif.
class Vrt : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(home / "below");
        fs::create_directories(folder / "outside");
        SyntheticRaster{}.write(home / "below" / "in.tif");
        SyntheticRaster{}.write(outside);
    }
    std::string read(const std::string& text, Trust trust = {}) {
        test::replace(home / "a.vrt", text);
        return result_of(home / "a.vrt", std::move(trust));
    }
    bool is_outside(const std::string& message) {
        return static_cast<bool>(test::says(message, {"a.vrt", "not below its own folder", "--allow-path"}));
    }

    SceneFolder folder;
    fs::path home = folder / "home";
    fs::path outside = folder / "outside" / "out.tif";
};

TEST_F(Vrt, ReadsBelowItsOwnFolder) {
    EXPECT_EQ(read(vrt_of("below/in.tif")), "read");
    EXPECT_EQ(read(vrt_of("./below/../below/in.tif")), "read");
    EXPECT_EQ(read(vrt_of((home / "below" / "in.tif").string(), false)), "read");
    EXPECT_TRUE(test::says(read(vrt_of("below/gone.tif")), {"a.vrt", "below/gone.tif", "no such file"}));
}

TEST_F(Vrt, ReadsNowhereElseUnlessAllowed) {
    for (const auto& text : {vrt_of("../outside/out.tif"), vrt_of("below/../../outside/out.tif"),
                             vrt_of(outside.string(), false), vrt_of(outside.string(), true)}) {
        EXPECT_TRUE(is_outside(read(text))) << text;
        EXPECT_EQ(read(text, {.allow_remote = false, .allow_paths = {folder / "outside"}}), "read") << text;
        EXPECT_TRUE(is_outside(read(text, {.allow_remote = false, .allow_paths = {folder / "out", home}})))
            << text;
        EXPECT_TRUE(is_outside(read(text, {.allow_remote = true, .allow_paths = {}}))) << text;
    }
    EXPECT_TRUE(is_outside(read(vrt_of("/etc/passwd", false))));
    EXPECT_TRUE(is_outside(read(vrt_of("/vsisubfile/0_100,/etc/passwd", false))));
    EXPECT_TRUE(is_outside(read(vrt_of("NETCDF:/etc/passwd:z", false))));
    // As raw bytes, any file is a raster.
    EXPECT_TRUE(is_outside(read(
        R"(<VRTDataset rasterXSize="2" rasterYSize="2"><VRTRasterBand dataType="Byte" band="1" )"
        R"(subClass="VRTRawRasterBand"><SourceFilename>/etc/passwd</SourceFilename></VRTRasterBand></VRTDataset>)")));
    EXPECT_TRUE(is_outside(read(R"(<VRTDataset rasterXSize="2" rasterYSize="2" subClass="VRTWarpedDataset">)"
                                R"(<GDALWarpOptions><SourceDataset relativeToVRT="1">../outside/out.tif)"
                                R"(</SourceDataset></GDALWarpOptions></VRTDataset>)")));
}

TEST_F(Vrt, LinksAreFollowed) {
    fs::create_symlink(outside, home / "link.tif");
    EXPECT_TRUE(is_outside(read(vrt_of("link.tif"))));
    fs::create_directory_symlink(folder / "outside", home / "linked");
    EXPECT_TRUE(is_outside(read(vrt_of("linked/out.tif"))));
    // The VRT itself named by a link: its own folder is where it is.
    read(vrt_of("below/in.tif"));
    fs::create_symlink(home / "a.vrt", folder / "outside" / "b.vrt");
    EXPECT_EQ(result_of(folder / "outside" / "b.vrt"), "read");
}

TEST_F(Vrt, NestedOnesAreHeldToTheSame) {
    test::replace(home / "below" / "inner.vrt", vrt_of("in.tif"));
    EXPECT_EQ(read(vrt_of("below/inner.vrt")), "read");
    test::replace(home / "below" / "inner.vrt", vrt_of("../../outside/out.tif"));
    EXPECT_TRUE(is_outside(read(vrt_of("below/inner.vrt"))));
    test::replace(home / "below" / "inner.tif", vrt_of(outside.string(), false));  // whatever its extension
    EXPECT_TRUE(is_outside(read(vrt_of("below/inner.tif"))));
    test::replace(home / "below" / "inner.vrt", vrt_of("../a.vrt"));  // a ring ends, somehow
    EXPECT_NE(read(vrt_of("below/inner.vrt")), "read");
}

TEST_F(Vrt, NoNetworkNoServicesNoPrograms) {
    EXPECT_TRUE(test::says(read(vrt_of("/vsicurl/http://localhost:9/a.tif", false)),
                           {"a.vrt", "from a network", "--allow-remote"}));
    EXPECT_TRUE(test::says(read(vrt_of("http://localhost:9/a.tif", false)), {"from a network"}));
    EXPECT_TRUE(
        test::says(read(vrt_of("/vsizip//vsicurl/http://localhost:9/a.zip/a.tif", false)), {"network"}));
    test::replace(home / "service.xml", "<GDAL_WMS><Service name=\"WMS\"/></GDAL_WMS>");
    EXPECT_TRUE(test::says(read(vrt_of("service.xml")), {"a.vrt", "service.xml", "not an elevation raster"}));
    EXPECT_NE(read(vrt_of("PG:host=localhost", false)), "read");
    EXPECT_NE(read(vrt_of("MEM:::DATAPOINTER=1,PIXELS=20,LINES=10", false)), "read");
    EXPECT_TRUE(test::says(
        read(vrt_of(
            "below/in.tif", true,
            "<PixelFunctionType>f</PixelFunctionType><PixelFunctionLanguage>Python</PixelFunctionLanguage>")),
        {"a.vrt", "program"}));
    EXPECT_NE(read("<VRTDataset rasterXSize=\"20\""), "read");
    std::string deep = "<VRTDataset>";
    for (int i = 0; i < 5000; ++i) deep += "<a>";
    EXPECT_NE(read(deep), "read");
}

TEST_F(Vrt, InsideAnArchive) {
    const auto zip = (home / "tiles.zip").string();
    const auto add = [&](const std::string& name, const std::string& bytes) {
        VSILFILE* out = VSIFOpenL(("/vsizip/" + zip + "/" + name).c_str(), "wb");
        ASSERT_NE(out, nullptr);
        VSIFWriteL(bytes.data(), 1, bytes.size(), out);
        VSIFCloseL(out);
    };
    add("dem/in.tif", test::contents(outside));
    add("dem/good.vrt", vrt_of("in.tif"));
    add("dem/climbs.vrt", vrt_of("../../../../../../../../etc/passwd"));
    add("dem/absolute.vrt", vrt_of(outside.string(), false));
    const std::string inside = "/vsizip/" + zip + "/dem/";
    EXPECT_EQ(result_of(inside + "good.vrt"), "read");
    EXPECT_TRUE(test::says(result_of(inside + "climbs.vrt"), {"not below its own folder"}));
    EXPECT_TRUE(test::says(result_of(inside + "absolute.vrt"), {"not below its own folder"}));
    // A VRT beside the archive may read it.
    EXPECT_EQ(read(vrt_of("/vsizip/" + zip + "/dem/in.tif", false)), "read");
    fs::copy(zip, folder / "outside" / "tiles.zip");
    EXPECT_TRUE(is_outside(
        read(vrt_of("/vsizip/" + (folder / "outside" / "tiles.zip").string() + "/dem/in.tif", false))));
}

TEST(Trust, NamesThatLeadElsewhere) {
    for (const char* name :
         {"http://localhost:9/a.tif", "/vsicurl/http://localhost:9/a.tif", "/vsis3/bucket/a.tif",
          "/vsizip//vsicurl/http://localhost:9/a.zip", "NETCDF:http://localhost:9/a.nc:z"})
        EXPECT_TRUE(test::says(result_of(name), {"network", "--allow-remote"})) << name;
    for (const char* name : {"<VRTDataset rasterXSize=\"1\" rasterYSize=\"1\"/>", " <GDAL_WMS/>",
                             "{\"type\": 1}", "vrt:///etc/passwd", "/vsistdin/"})
        EXPECT_TRUE(test::says(result_of(name), {"not the name of a file"})) << name;
    // Allowed, it is tried: nothing listens there.
    Trust remote;
    remote.allow_remote = true;
    EXPECT_FALSE(test::says(result_of("/vsicurl/http://localhost:9/a.tif", remote), {"--allow-remote"}));
}

TEST(Trust, FormatsThatAreNotForHeights) {
    const SceneFolder folder;
    test::replace(folder / "wms.xml",
                  "<GDAL_WMS><Service name=\"WMS\"><ServerUrl>http://localhost:9/</ServerUrl>"
                  "</Service></GDAL_WMS>");
    EXPECT_TRUE(test::says(result_of(folder / "wms.xml"), {"wms.xml", "not for heights"}));
    SyntheticRaster picture;
    picture.driver = "SGI";
    picture.type = GDT_Byte;
    picture.georeferenced = false;
    picture.crs = "";
    EXPECT_TRUE(test::says(result_of(picture.write(folder / "a.rgb")),
                           {"a.rgb", "not for heights", "gdal_translate"}));
}

TEST(Trust, HeadersThatClaimTooMuch) {
    const SceneFolder folder;
    // GDAL writes no blocks of a sparse file: a few hundred bytes that claim 2^31 - 1 columns.
    SyntheticRaster raster;
    raster.creation_options = {"SPARSE_OK=TRUE", "TILED=YES", "BIGTIFF=YES", "BLOCKXSIZE=65536",
                               "BLOCKYSIZE=65536"};
    GDALAllRegister();
    auto* format = GetGDALDriverManager()->GetDriverByName("GTiff");
    char** options = nullptr;
    for (const auto& option : raster.creation_options) options = CSLAddString(options, option.c_str());
    const auto file = folder / "huge.tif";
    GDALClose(format->Create(file.c_str(), 2147483000, 10, 1, GDT_Byte, options));
    const auto message = result_of(file);
    EXPECT_TRUE(test::says(message, {"huge.tif", "2147483000 x 10", "bytes"}) ||
                test::says(message, {"huge.tif", "blocks of 65536 x 65536"}));
    GDALClose(format->Create(file.c_str(), 40000, 40000, 1, GDT_Float32, options));
    EXPECT_TRUE(test::says(result_of(file), {"huge.tif"}));
    CSLDestroy(options);
    const DatasetPtr dataset{GDALDataset::Open(file.c_str())};
    ASSERT_TRUE(dataset);
    const auto size = check_size(*dataset, "huge.tif", {});  // as if it were a VRT, or large
    ASSERT_FALSE(size);
    EXPECT_TRUE(test::says(size.error().message, {"blocks of 65536 x 65536", "TILED=YES"}));
    EXPECT_FALSE(check_size(*dataset, "huge.tif", 200));
}

}  // namespace
}  // namespace relevo::ingest
