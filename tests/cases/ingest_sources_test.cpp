// Hard case 1 as one source meets it: units, datums, and the formats that heights come in.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ingest/source/source.hpp"
#include "tests/ingest/importing.hpp"
#include "tests/shared_data.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

lod::Raster<double> read_all(const SourceRequest& request, const std::string& what) {
    const auto source = Source::open(request);
    EXPECT_TRUE(source) << what << ": " << source.error().message;
    if (!source) return {};
    auto heights = source->read({0, 0, source->columns(), source->rows()});
    EXPECT_TRUE(heights) << what;
    return heights ? std::move(*heights) : lod::Raster<double>{};
}

// --- Units

double surface(int column, int row) {
    return 3000 + 40.123 * std::sin(column / 3.0) + 25.777 * std::cos(row / 2.0);
}

TEST(Units, TheSameSurfaceInMetresAndBothFeet) {
    struct Case {
        const char* what;
        const char* unit;  // of the band
        const char* crs;
        double metres;  // per unit of value; negative: depths
    };
    constexpr double kFoot = 0.3048;
    const double survey_foot = 1200.0 / 3937;
    const Case cases[] = {
        {"metres", "m", "EPSG:26911", 1},
        {"nothing said", "", "EPSG:26911", 1},
        {"ft in the band", "ft", "EPSG:26911", kFoot},
        {"foot in the band", "foot", "EPSG:26911", kFoot},
        {"US survey foot in the band", "US survey foot", "EPSG:26911", survey_foot},
        {"us-ft in the band", "us-ft", "EPSG:26911", survey_foot},
        {"ftUS in the band", "ftUS", "EPSG:26911", survey_foot},
        {"NAVD88 height", "", "EPSG:26911+5703", 1},
        {"NAVD88 height (ftUS)", "", "EPSG:26911+6360", survey_foot},
        {"NAVD88 height (ft)", "", "EPSG:26911+8228", kFoot},
        {"both say ftUS", "ftUS", "EPSG:26911+6360", survey_foot},
        {"NAVD88 depth", "", "EPSG:26911+6357", -1},
        {"NAVD88 depth (ftUS)", "", "EPSG:26911+6358", -survey_foot},
        {"MSL height (ft)", "", "EPSG:26911+8050", kFoot},
    };
    const SceneFolder folder;
    for (const Case& c : cases) {
        SyntheticRaster raster;
        raster.type = GDT_Float64;
        raster.crs = c.crs;
        raster.geotransform = {400000, 30, 0, 3800000, 0, -30};
        raster.unit = c.unit;
        raster.value = [&](int column, int row) { return surface(column, row) / c.metres; };
        SourceRequest request;
        request.input = raster.write(folder / "a.tif").string();
        const auto heights = read_all(request, c.what);
        ASSERT_EQ(heights.columns(), 20) << c.what;
        for (int r = 0; r < 10; ++r)
            for (int column = 0; column < 20; ++column)
                ASSERT_NEAR(heights.at(column, r), surface(column, r), 0.001) << c.what;
    }
    // The two feet are 6 mm apart at 3000 m: taking one for the other would have been seen.
    EXPECT_GT(std::abs(3000 / kFoot * survey_foot - 3000), 0.005);
}

// IDRISI writes "unspecified" where nobody said anything.
TEST(Units, UnspecifiedIsNothingSaid) {
    for (const char* unit : {"unspecified", "unknown", "Unknown", "none", "n/a"}) {
        const SceneFolder folder;
        SyntheticRaster raster;
        raster.unit = unit;
        SourceRequest request;
        request.input = raster.write(folder / "a.tif").string();
        EXPECT_EQ(read_all(request, unit).at(0, 0), 100);
    }
}

TEST(Units, ADisagreementStopsTheImport) {
    struct Case {
        const char* unit;
        const char* crs;
    };
    for (const Case& c :
         {Case{"ft", "EPSG:26911+5703"}, Case{"m", "EPSG:26911+6360"}, Case{"ft", "EPSG:26911+6360"},
          Case{"us-ft", "EPSG:26911+8228"}, Case{"US survey foot", "EPSG:26911+5703"}}) {
        const SceneFolder folder;
        SyntheticRaster raster;
        raster.crs = c.crs;
        raster.geotransform = {400000, 30, 0, 3800000, 0, -30};
        raster.unit = c.unit;
        auto options = test::options_for(raster.write(folder / "torn.tif"));
        EXPECT_TRUE(
            test::says(test::refused(folder, options), {"torn.tif", c.unit, "NAVD88", "--height-scale"}))
            << c.unit << " " << c.crs;
        options.mosaic.sources.front().height_scale = 0.3048;
        EXPECT_NEAR(read_all(options.mosaic.sources.front(), "told").at(0, 0), 100 * 0.3048, 1e-9);
    }
}

// --- Formats

/// What a format can hold of a 24 x 18 raster of 30 m posts, and what has to be told.
struct Format {
    const char* driver;
    const char* file;
    GDALDataType type = GDT_Float32;
    double tolerance = 0;  // metres
    bool names_crs = true;
    std::vector<std::string> creation_options = {};
};

void PrintTo(const Format& format, std::ostream* out) {
    *out << format.driver;
}

double format_height(int column, int row) {
    return 1000 + 3 * column - 7 * row + column * row % 5;
}

class Formats : public testing::TestWithParam<Format> {};

TEST_P(Formats, GiveHeightsAndPlacesBack) {
    const Format& f = GetParam();
    GDALAllRegister();
    auto* driver = GetGDALDriverManager()->GetDriverByName(f.driver);
    if (driver == nullptr) GTEST_SKIP() << "this GDAL has no " << f.driver;
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.columns = 24;
    raster.rows = 18;
    raster.crs = "EPSG:32632";
    raster.geotransform = {700000, 30, 0, 5200000, 0, -30};
    raster.type = f.type;
    raster.value = format_height;
    const auto plain = raster.write(folder / "plain.tif");
    char** options = nullptr;
    for (const auto& option : f.creation_options) options = CSLAddString(options, option.c_str());
    {
        const DatasetPtr from{GDALDataset::Open(plain.c_str())};
        const DatasetPtr to{
            driver->CreateCopy((folder / f.file).c_str(), from.get(), FALSE, options, nullptr, nullptr)};
        ASSERT_TRUE(to) << CPLGetLastErrorMsg();
    }
    CSLDestroy(options);

    SourceRequest request;
    request.input = (folder / f.file).string();
    if (!f.names_crs) {
        const auto without = Source::open(request);
        ASSERT_FALSE(without);
        EXPECT_TRUE(test::says(without.error().message, {f.file, "--crs"}));
        request.crs = "EPSG:32632";
    }
    const auto source = Source::open(request);
    ASSERT_TRUE(source) << source.error().message;
    ASSERT_EQ(source->columns(), 24);
    ASSERT_EQ(source->rows(), 18);
    const auto heights = source->read({0, 0, 24, 18});
    ASSERT_TRUE(heights) << heights.error().message;
    for (int r = 0; r < 18; ++r)
        for (int c = 0; c < 24; ++c) {
            const Place place = source->posts().at({double(c), double(r)});
            // Some formats are written from the south.
            const double row = (5200000 - 15 - place.y) / 30;
            ASSERT_NEAR(place.x, 700015 + 30 * c, 1e-4);
            ASSERT_NEAR(row, std::round(row), 1e-6);
            ASSERT_NEAR(heights->at(c, r), format_height(c, static_cast<int>(std::lround(row))), f.tolerance);
        }
}

INSTANTIATE_TEST_SUITE_P(
    Every, Formats,
    testing::Values(
        Format{"GTiff", "a.tif", GDT_Float64}, Format{"GTiff", "b.tif", GDT_Int16},
        Format{"GTiff", "c.tif", GDT_UInt16}, Format{"GTiff", "d.tif", GDT_Int32},
        Format{"GTiff", "e.tif", GDT_Float32, 0, true, {"COMPRESS=LZW", "PREDICTOR=3", "TILED=YES"}},
        Format{"GTiff", "f.tif", GDT_Int16, 0, true, {"COMPRESS=ZSTD", "PREDICTOR=2"}},
        Format{"GTiff", "g.tif", GDT_Float32, 0, true, {"ENDIANNESS=BIG", "BIGTIFF=YES"}},
        Format{"COG", "h.tif"}, Format{"AAIGrid", "i.asc"}, Format{"netCDF", "j.nc"}, Format{"HFA", "k.img"},
        Format{"ENVI", "l.envi"}, Format{"EHdr", "m.bil"}, Format{"SAGA", "n.sdat"},
        Format{"GSAG", "o.grd", GDT_Float32, 0.001}, Format{"GSBG", "p.grd"},
        Format{"GS7BG", "q.grd", GDT_Float64}, Format{"RMF", "r.mtw", GDT_Float64, 0, true, {"MTW=YES"}},
        Format{"RST", "s.rst"}, Format{"BT", "t.bt"}, Format{"XYZ", "u.xyz", GDT_Float32, 0, false},
        Format{"ZMap", "v.dat", GDT_Float32, 0.01, false}, Format{"SIGDEM", "w.sigdem", GDT_Float64, 0.001},
        Format{"PCRaster", "x.map"}, Format{"PNG", "y.png", GDT_UInt16, 0, true, {"WORLDFILE=YES"}},
        Format{"GPKG", "z.gpkg", GDT_Int16}),
    [](const auto& format) { return std::string{format.param.driver} + format.param.file[0]; });

// Height maps without a place: 8 and 16 bits of grey (the LSTR document's inputs).
TEST(Pictures, GreyHeightMapsTakeTheirPlaceFromTheUser) {
    struct Case {
        const char* driver;
        const char* file;
        GDALDataType type;
    };
    for (const Case& c : {Case{"PNG", "a.png", GDT_Byte}, Case{"PNG", "b.png", GDT_UInt16},
                          Case{"BMP", "c.bmp", GDT_Byte}, Case{"GTiff", "d.tif", GDT_Byte},
                          Case{"GTiff", "e.tif", GDT_UInt16}, Case{"PNM", "f.pgm", GDT_UInt16}}) {
        const SceneFolder folder;
        const int factor = c.type == GDT_Byte ? 1 : 250;
        SyntheticRaster raster;
        raster.georeferenced = false;
        raster.crs = "";
        raster.type = c.type;
        raster.value = [&](int column, int row) { return factor * (10 + 5 * column + 7 * row); };
        const auto plain = raster.write(folder / "plain.tif");
        {
            const DatasetPtr from{GDALDataset::Open(plain.c_str())};
            auto* driver = GetGDALDriverManager()->GetDriverByName(c.driver);
            ASSERT_NE(driver, nullptr) << c.driver;
            const DatasetPtr to{
                driver->CreateCopy((folder / c.file).c_str(), from.get(), FALSE, nullptr, nullptr, nullptr)};
            ASSERT_TRUE(to);
        }
        SourceRequest request;
        request.input = (folder / c.file).string();
        const auto nowhere = Source::open(request);
        ASSERT_FALSE(nowhere);
        EXPECT_TRUE(test::says(nowhere.error().message, {c.file, "--bounds"}));
        request.bounds = Bounds{10, 45, 12, 46};
        const auto unnamed = Source::open(request);
        ASSERT_FALSE(unnamed);
        EXPECT_TRUE(test::says(unnamed.error().message, {c.file, "--crs"}));
        request.crs = "EPSG:4326";
        request.height_scale = 0.5;
        request.height_offset = 100;
        const auto heights = read_all(request, c.file);
        ASSERT_EQ(heights.columns(), 20);
        for (int r = 0; r < 10; ++r)
            for (int column = 0; column < 20; ++column)
                ASSERT_EQ(heights.at(column, r), factor * (10 + 5 * column + 7 * r) * 0.5 + 100) << c.file;
    }
}

TEST(RealFormats, DtedHgtAndUsgsDemOfTheDevelopers) {
    RELEVO_NEEDS_DATA("odd/SainteHelens.dem");
    struct Case {
        const char* file;
        int columns, rows;
        double lowest, highest;  // of all posts, as the catalogue has them
    };
    for (const Case& c : {Case{"odd/SainteHelens.dem", 327, 468, 682, 2543},
                          Case{"mosaic/gabon/N00E010.hgt", 1201, 1201, 1, 1005},
                          Case{"coast/N43E007.hgt.zip", 1201, 1201, -11, 2064},
                          Case{"coast/cairns.zip", 1584, 1188, -2153, 1599},
                          Case{"mosaic/logan/logan.vrt", 0, 0, 1358, 3026}}) {
        SourceRequest request;
        request.input = test::shared_data(c.file).string();
        const auto source = Source::open(request);
        ASSERT_TRUE(source) << source.error().message;
        if (c.columns > 0) {
            EXPECT_EQ(source->columns(), c.columns);
            EXPECT_EQ(source->rows(), c.rows);
        }
        double lowest = std::numeric_limits<double>::infinity();
        double highest = -lowest;
        const auto heights = source->read({0, 0, source->columns(), source->rows()});
        ASSERT_TRUE(heights);
        for (const double height : heights->samples()) {
            if (height < lowest) lowest = height;
            if (height > highest) highest = height;
        }
        EXPECT_NEAR(lowest, c.lowest, 1) << c.file;
        EXPECT_NEAR(highest, c.highest, 1) << c.file;
    }
}

TEST(RealFormats, TerrainRgbIsTheHeightMapOfTheSameTile) {
    RELEVO_NEEDS_DATA("odd/fuji_terrainrgb.png");
    // The edges of the web tile 10/906/404: Mercator's world is 2 pi 6378137 m wide.
    const double world = 2 * 3.14159265358979323846 * 6378137;
    const double side = world / 1024;
    SourceRequest colours;
    colours.input = test::shared_data("odd/fuji_terrainrgb.png").string();
    colours.crs = "EPSG:3857";
    colours.bounds = Bounds{906 * side - world / 2, world / 2 - 405 * side, 907 * side - world / 2,
                            world / 2 - 404 * side};
    const auto refused = Source::open(colours);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(test::says(refused.error().message, {"fuji_terrainrgb.png", "--encoding terrain-rgb"}));
    colours.encoding = HeightEncoding::terrain_rgb;
    SourceRequest grey;
    grey.input = test::shared_data("odd/fuji_dm_u16.png").string();
    grey.crs = "EPSG:3857";
    grey.height_scale = 0.1;
    const auto a = Source::open(colours);
    const auto b = Source::open(grey);
    ASSERT_TRUE(a) << a.error().message;
    ASSERT_TRUE(b) << b.error().message;
    for (const Place post : {Place{0, 0}, Place{511, 0}, Place{511, 511}}) {
        EXPECT_NEAR(a->posts().at(post).x, b->posts().at(post).x, 0.01);
        EXPECT_NEAR(a->posts().at(post).y, b->posts().at(post).y, 0.01);
    }
    const auto heights = a->read({0, 0, 512, 512});
    const auto truth = b->read({0, 0, 512, 512});
    ASSERT_TRUE(heights && truth);
    double highest = 0;
    double furthest = 0;
    for (std::size_t i = 0; i < truth->samples().size(); ++i) {
        furthest = std::max(furthest, std::abs(heights->samples()[i] - truth->samples()[i]));
        highest = std::max(highest, heights->samples()[i]);
    }
    EXPECT_LE(furthest, 0.1);
    EXPECT_NEAR(highest, 3751, 1);
}

}  // namespace
}  // namespace relevo::ingest
