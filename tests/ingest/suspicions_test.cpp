#include "ingest/source/suspicions.hpp"

#include <gtest/gtest.h>

#include "tests/ingest/importing.hpp"
#include "tests/shared_data.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

geo::LatLon at(double lat, double lon) {
    return {geo::Degrees{lat}, geo::Degrees{lon}};
}

std::string notes_of(const SourceRequest& request, const std::optional<geo::LatLon>& where = {}) {
    const auto source = Source::open(request);
    EXPECT_TRUE(source) << source.error().message;
    if (!source) return {};
    const auto notes = suspicions(*source, where);
    EXPECT_TRUE(notes);
    return notes ? fmt::format("{}", fmt::join(*notes, "\n")) : "";
}

SyntheticRaster ground(int columns = 900, int rows = 700) {
    SyntheticRaster raster;
    raster.columns = columns;
    raster.rows = rows;
    raster.geotransform = {10, 0.001, 0, 47, 0, -0.001};
    raster.type = GDT_Float32;
    raster.value = [](int c, int r) { return 800 + 300 * std::sin(c / 50.0) + 200 * std::cos(r / 70.0); };
    return raster;
}

TEST(Suspicions, NoneAboutPlainGround) {
    const SceneFolder folder;
    SourceRequest request;
    request.input = ground().write(folder / "a.tif").string();
    EXPECT_EQ(notes_of(request, at(46.5, 10.5)), "");
    request.input = SyntheticRaster{}.write(folder / "small.tif").string();
    EXPECT_EQ(notes_of(request), "");
}

TEST(Suspicions, UndeclaredVoids) {
    const SceneFolder folder;
    for (const double code : {-32768.0, -32767.0, -9999.0, 32767.0, -3.4e38, -500.0 * 10, 20000.0}) {
        SyntheticRaster raster = ground();
        const auto plain = raster.value;
        raster.value = [&](int c, int r) { return c < 60 && r < 60 ? code : plain(c, r); };
        SourceRequest request;
        request.input = raster.write(folder / "a.tif").string();
        EXPECT_TRUE(test::says(notes_of(request), {"means void", "--nodata"})) << code;
        request.height_scale = 0.3048;  // the value is told as the file has it
        EXPECT_TRUE(
            test::says(notes_of(request), {fmt::format("--nodata {:.6g}", code).substr(0, 11).c_str()}))
            << code;
        request.nodata = static_cast<double>(static_cast<float>(code));
        EXPECT_EQ(notes_of(request), "") << code;
    }
}

TEST(Suspicions, ACliffALakeAndASpikeAreNone) {
    const SceneFolder folder;
    SyntheticRaster raster = ground();
    const auto plain = raster.value;
    raster.value = [&](int c, int r) {
        if (c == 444 && r == 333) return 8000.0;  // one post
        if (c > 300 && c < 500) return 250.0;     // a lake below a cliff
        return plain(c, r);
    };
    SourceRequest request;
    request.input = raster.write(folder / "a.tif").string();
    EXPECT_EQ(notes_of(request, at(46.5, 10.5)), "");
}

TEST(Suspicions, HigherThanGroundCanBe) {
    const SceneFolder folder;
    SyntheticRaster raster = ground();
    raster.value = [](int c, int r) {
        return 3.28 * (3000 + 500 * std::sin(c / 50.0) + 200 * std::cos(r / 70.0));
    };
    SourceRequest request;
    request.input = raster.write(folder / "a.tif").string();
    EXPECT_TRUE(test::says(notes_of(request), {"on earth", "--height-scale 0.3048"}));
    EXPECT_TRUE(
        test::says(notes_of(request, at(46.5, 10.5)), {"heights reach 121", "4810 m", "--height-scale 0.1"}));
    request.height_scale = 0.5;  // 6 km: there are such mountains, but not here
    EXPECT_EQ(notes_of(request), "");
    EXPECT_TRUE(test::says(notes_of(request, at(46.5, 10.5)), {"in that part of the world"}));
    EXPECT_EQ(notes_of(request, at(28, 86.9)), "");
}

TEST(Suspicions, OfSeveralSourcesWithTheirNames) {
    const SceneFolder folder;
    SyntheticRaster raster = ground(100, 80);
    std::vector<SourceRequest> requests(3);
    requests[0].input = raster.write(folder / "good.tif").string();
    raster.crs = "EPSG:32632";
    raster.geotransform = {600000, 30, 0, 5200000, 0, -30};
    raster.value = [](int c, int r) { return 6000 + c + r; };  // in the Alps
    requests[1].input = raster.write(folder / "high.tif").string();
    requests[2].input = (folder / "gone.tif").string();
    const auto notes = suspicions_about(requests);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_TRUE(test::says(notes[0], {"high.tif: ", "in that part of the world", "4810 m"}));
    EXPECT_EQ(suspicions_about(std::vector<SourceRequest>(1000, requests[1])).size(), 32U);
}

TEST(Suspicions, HighestGroundHoldsTheMountainsOfThere) {
    struct Peak {
        double lat, lon, height;
    };
    for (const Peak& peak :
         {Peak{27.988, 86.925, 8849}, Peak{45.833, 6.865, 4806}, Peak{63.069, -151.006, 6190},
          Peak{-32.653, -70.012, 6961}, Peak{-3.076, 37.353, 5895}, Peak{43.355, 42.439, 5642},
          Peak{36.578, -118.292, 4421}, Peak{19.030, -97.268, 5636}, Peak{60.567, -140.405, 5959},
          Peak{35.361, 138.727, 3776}, Peak{-4.079, 137.158, 4884}, Peak{-43.595, 170.142, 3724},
          Peak{-78.525, -85.617, 4892}, Peak{68.919, -29.898, 3694}, Peak{39.702, 44.298, 5137},
          Peak{6.075, 116.558, 4095}, Peak{81.79, -74.01, 2616}, Peak{37.056, -3.311, 3479}})
        EXPECT_GE(highest_ground_m(at(peak.lat, peak.lon)), peak.height) << peak.lat << " " << peak.lon;
    EXPECT_LT(highest_ground_m(at(46, 370)), 5000);
}

// Steep ground, coasts, and voids that are declared: nothing to suspect.
TEST(Suspicions, RealFiles) {
    RELEVO_NEEDS_DATA("mountains/bigtujunga.tif");
    SourceRequest request;
    request.input = test::shared_data("mountains/bigtujunga.tif").string();
    EXPECT_EQ(notes_of(request, at(34.3, -118.1)), "");
    for (const char* file : {"mountains/mt_everest_90m.tif", "coast/N43E007.hgt.zip", "coast/columbia.tif",
                             "mosaic/california/w122_n39.dt0", "odd/netherlands_cog_egm96.tif"}) {
        request.input = test::shared_data(file).string();
        EXPECT_EQ(notes_of(request), "") << file;
    }
}

}  // namespace
}  // namespace relevo::ingest
