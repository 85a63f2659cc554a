#include "ingest/sea/sea_mask.hpp"

#include <array>
#include <cmath>
#include <fstream>

#include <GeographicLib/UTMUPS.hpp>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include "tests/ingest/classifying.hpp"
#include "tests/ingest/synthetic_raster.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::ingest {
namespace {

using test::SceneFolder;
using Corners = std::vector<std::array<double, 2>>;

geo::GridFrame grid(double west, double north, double step, int columns, int rows) {
    return {geo::FrameKind::geographic, west, north, step, step, columns, rows};
}

/// Polygons of one ring each, by OGR.
std::string write_polygons(const std::filesystem::path& file, const char* driver, const char* crs,
                           const std::vector<Corners>& polygons) {
    GDALAllRegister();
    auto* format = GetGDALDriverManager()->GetDriverByName(driver);
    const DatasetPtr dataset{format->Create(file.c_str(), 0, 0, 0, GDT_Unknown, nullptr)};
    EXPECT_TRUE(dataset);
    OGRSpatialReference reference;
    EXPECT_EQ(reference.SetFromUserInput(crs), OGRERR_NONE);
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRLayer* layer = dataset->CreateLayer("sea", &reference, wkbPolygon, nullptr);
    EXPECT_NE(layer, nullptr);
    for (const Corners& corners : polygons) {
        OGRLinearRing ring;
        for (const auto& corner : corners) ring.addPoint(corner[0], corner[1]);
        ring.closeRings();
        OGRPolygon polygon;
        polygon.addRing(&ring);
        OGRFeature feature(layer->GetLayerDefn());
        feature.SetGeometry(&polygon);
        EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
    }
    return file.string();
}

lod::Raster<std::uint8_t> read_all(const std::string& file, const geo::GridFrame& frame) {
    const auto mask = SeaMask::open(file, {}, frame);
    lod::Raster<std::uint8_t> sea(frame.columns, frame.rows);
    if (!mask) {
        ADD_FAILURE() << mask.error().message;
        return sea;
    }
    EXPECT_TRUE(mask->read({0, 0, frame.columns, frame.rows}, sea));
    for (const int side : {7, 32}) {  // the blocks make no difference
        for (const Window block : test::blocks_of(frame.columns, frame.rows, side)) {
            lod::Raster<std::uint8_t> part(block.columns, block.rows, 9);
            EXPECT_TRUE(mask->read(block, part));
            EXPECT_EQ(part.samples(), test::part(sea, block).samples()) << block.column << " " << block.row;
        }
    }
    return sea;
}

std::string refusal_of(const std::string& file) {
    const auto mask = SeaMask::open(file, {}, grid(10, 50, 0.01, 20, 10));
    if (mask) return "opened";
    EXPECT_EQ(mask.error().kind, ErrorKind::input) << mask.error().message;
    return mask.error().message;
}

TEST(SeaMask, PolygonsInDegrees) {
    const SceneFolder folder;
    const auto frame = grid(10, 50, 0.01, 90, 70);
    for (const auto& [name, driver] : {std::pair{"sea.geojson", "GeoJSON"},
                                       {"sea.shp", "ESRI Shapefile"},
                                       {"sea.gpkg", "GPKG"},
                                       {"sea.fgb", "FlatGeobuf"}}) {
        const auto file =
            write_polygons(folder / name, driver, "EPSG:4326",
                           {{{10.095, 49.955}, {10.505, 49.955}, {10.505, 49.405}, {10.095, 49.405}},
                            {{10.6, 49.9}, {10.8, 49.9}, {10.8, 49.5}}});
        const auto sea = read_all(file, frame);
        std::size_t count = 0;
        for (int r = 0; r < 70; ++r) {
            for (int c = 0; c < 90; ++c) {
                const double x = 10 + 0.01 * c;
                const double y = 50 - 0.01 * r;
                const bool box = x > 10.095 && x < 10.505 && y < 49.955 && y > 49.405;
                // Below the line from (10.6, 49.9) to (10.8, 49.5), to the east of it.
                const double edge = 2 * (x - 10.6) - (49.9 - y);
                const bool triangle = edge > 0 && x < 10.8 && y < 49.9;
                if (std::abs(edge) < 1e-9 || std::abs(x - 10.8) < 1e-9 || std::abs(y - 49.9) < 1e-9) continue;
                EXPECT_EQ(sea.at(c, r), box || triangle) << driver << " " << c << "," << r;
                count += sea.at(c, r);
            }
        }
        EXPECT_GT(count, 2000U);
    }
}

/// Edges that are straight in UTM are curves in the grid: by 1.7 km in this one. GeographicLib is the judge.
TEST(SeaMask, PolygonsInAnotherCrs) {
    const SceneFolder folder;
    const auto frame = grid(7, 51, 0.02, 220, 60);
    const auto file =
        write_polygons(folder / "sea.gpkg", "GPKG", "EPSG:32632",
                       {{{350000, 5600000}, {680000, 5600000}, {680000, 5570000}, {350000, 5570000}}});
    const auto sea = read_all(file, frame);
    std::size_t count = 0;
    for (int r = 0; r < frame.rows; ++r) {
        for (int c = 0; c < frame.columns; ++c) {
            int zone = 0;
            bool north = false;
            double x = 0;
            double y = 0;
            GeographicLib::UTMUPS::Forward(51 - 0.02 * r, 7 + 0.02 * c, zone, north, x, y, 32);
            const double inside = std::min({x - 350000, 680000 - x, y - 5570000, 5600000 - y});
            if (std::abs(inside) < 5) continue;  // chords of 8 posts, 11 km, sag by 3 m: 0.002 of a post
            ASSERT_EQ(sea.at(c, r) == 1, inside > 0) << c << "," << r << " " << inside;
            count += sea.at(c, r);
        }
    }
    EXPECT_GT(count, 2000U);
}

TEST(SeaMask, RastersInAnyCrs) {
    const SceneFolder folder;
    test::SyntheticRaster raster;
    raster.crs = "EPSG:32632";
    raster.geotransform = {400000, 1000, 0, 5620000, 0, -1000};
    raster.columns = 120;
    raster.rows = 70;
    raster.type = GDT_Byte;
    raster.nodata = 255;
    raster.value = [](int c, int r) { return c / 10 % 3 == 0 ? 0 : (r / 10 % 4 == 1 ? 255 : c % 7 + 1); };
    const auto frame = grid(7.5, 50.8, 0.013, 130, 60);
    const auto sea = read_all(raster.write(folder / "sea.tif").string(), frame);
    std::size_t count = 0;
    for (int r = 0; r < frame.rows; ++r) {
        for (int c = 0; c < frame.columns; ++c) {
            int zone = 0;
            bool north = false;
            double x = 0;
            double y = 0;
            GeographicLib::UTMUPS::Forward(50.8 - 0.013 * r, 7.5 + 0.013 * c, zone, north, x, y, 32);
            const double column = (x - 400000) / 1000;
            const double row = (5620000 - y) / 1000;
            const bool there = column >= 0 && row >= 0 && column < 120 && row < 70;
            const double value = there ? raster.value(static_cast<int>(column), static_cast<int>(row)) : 0;
            ASSERT_EQ(sea.at(c, r) == 1, value != 0 && value != 255) << c << "," << r;
            count += sea.at(c, r);
        }
    }
    EXPECT_GT(count, 1000U);
}

TEST(SeaMask, LongitudesInAnyTurn) {
    const SceneFolder folder;
    const auto fiji = grid(175, -10, 0.1, 101, 50);  // to 185 E
    // As most files have it: cut at 180 degrees.
    const auto cut = write_polygons(folder / "cut.geojson", "GeoJSON", "EPSG:4326",
                                    {{{178.05, -11.05}, {180, -11.05}, {180, -13.05}, {178.05, -13.05}},
                                     {{-180, -11.05}, {-178.05, -11.05}, {-178.05, -13.05}, {-180, -13.05}}});
    // And the whole ocean.
    const auto ocean = write_polygons(folder / "ocean.shp", "ESRI Shapefile", "EPSG:4326",
                                      {{{-180, 90}, {180, 90}, {180, -90}, {-180, -90}}});
    const auto sea = read_all(cut, fiji);
    const auto all = read_all(ocean, fiji);
    for (int r = 0; r < 50; ++r) {
        for (int c = 0; c < 101; ++c) {
            EXPECT_EQ(sea.at(c, r) == 1, c > 30 && c < 70 && r > 10 && r <= 30) << c << "," << r;
            EXPECT_EQ(all.at(c, r), 1) << c << "," << r;
        }
    }
    test::SyntheticRaster raster;
    raster.crs = "EPSG:4326";
    raster.geotransform = {-180, 1, 0, 90, 0, -1};
    raster.columns = 360;
    raster.rows = 180;
    raster.type = GDT_Byte;
    raster.value = [](int c, int) { return c == 0 || c == 359 ? 1 : 0; };
    const auto strip = read_all(raster.write(folder / "strip.tif").string(), fiji);
    for (int c = 0; c < 101; ++c) {
        if (c == 40 || c == 60) continue;
        EXPECT_EQ(strip.at(c, 9) == 1, c > 40 && c < 60) << c;
    }
}

TEST(SeaMask, AroundThePole) {
    const SceneFolder folder;
    geo::GridFrame frame;
    frame.kind = geo::FrameKind::ups_south;
    frame.west = geo::kUpsFalseOrigin - 1.5e6;
    frame.north = geo::kUpsFalseOrigin + 1.5e6;
    frame.step_x = 20000;
    frame.step_y = 20000;
    frame.columns = 151;
    frame.rows = 151;
    const auto file = write_polygons(folder / "cap.geojson", "GeoJSON", "EPSG:4326",
                                     {{{-180, -80}, {180, -80}, {180, -90}, {-180, -90}}});
    const auto sea = read_all(file, frame);
    for (int r = 0; r < 151; ++r) {
        for (int c = 0; c < 151; ++c) {
            const double lat = frame.lat_lon({static_cast<double>(c), static_cast<double>(r)}).lat.value;
            if (std::abs(lat + 80) < 0.02) continue;
            EXPECT_EQ(sea.at(c, r) == 1, lat < -80) << c << "," << r;
        }
    }
}

TEST(SeaMask, DecidesAlone) {
    const SceneFolder folder;
    test::Heights heights(60, 40, 300);
    for (int r = 0; r < 40; ++r) {
        for (int c = 0; c < 60; ++c) {
            if (c < 20) heights.at(c, r) = r < 20 ? std::nanf("") : -2000.0F;
            if (c > 50) heights.at(c, r) = 0;  // would be sea by itself
        }
    }
    const auto frame = grid(10, 50, 0.01, 60, 40);
    const auto file = write_polygons(folder / "sea.geojson", "GeoJSON", "EPSG:4326",
                                     {{{9, 51}, {10.295, 51}, {10.295, 49}, {9, 49}}});
    const auto scene = test::classify(heights, sea_request_from(file), 16, false, frame);
    EXPECT_EQ(scene.info.rule, lod::SeaInfo::Rule::mask);
    EXPECT_EQ(scene.info.mask, "sea.geojson");
    for (int r = 0; r < 40; ++r) {
        for (int c = 0; c < 60; ++c) {
            const auto mark = scene.marks.at(c, r);
            EXPECT_EQ(mark.post_class(), c < 30 ? lod::PostClass::sea : lod::PostClass::land);
            EXPECT_EQ(mark.modelled(), c < 20 && r < 20);
            EXPECT_TRUE(mark.modelled() || scene.heights.at(c, r) == heights.at(c, r));
        }
    }
    EXPECT_LT(scene.heights.at(0, 0), 0);
}

TEST(SeaMask, SaysWhatIsWrongWithAFile) {
    const SceneFolder folder;
    EXPECT_NE(refusal_of((folder / "none.shp").string()).find("there is no such file"), std::string::npos);
    EXPECT_NE(refusal_of("https://example.org/sea.geojson").find("network"), std::string::npos);
    std::ofstream(folder / "text.geojson") << "no polygons";
    EXPECT_NE(refusal_of((folder / "text.geojson").string()).find("text.geojson"), std::string::npos);
    std::ofstream(folder / "point.geojson")
        << R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}})";
    EXPECT_NE(refusal_of((folder / "point.geojson").string()).find("no polygons"), std::string::npos);
    write_polygons(folder / "bare.shp", "ESRI Shapefile", "EPSG:4326", {{{1, 1}, {2, 1}, {2, 2}}});
    std::filesystem::remove(folder / "bare.prj");
    EXPECT_NE(refusal_of((folder / "bare.shp").string()).find("coordinate reference system"),
              std::string::npos);
}

}  // namespace
}  // namespace relevo::ingest
