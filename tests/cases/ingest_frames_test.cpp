// Hard case 1: where the posts are. Peaks of known place, in frames of every kind.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ingest/operation.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::imported;
using test::options_for;
using test::SceneFolder;
using test::SyntheticRaster;

/// A cone whose top is at a place in the CRS, between posts.
SyntheticRaster cone(const std::string& crs, double x, double y, double step) {
    SyntheticRaster raster;
    raster.crs = crs;
    raster.type = GDT_Float32;
    raster.columns = 81;
    raster.rows = 61;
    raster.geotransform = {x - 40.3 * step, step, 0, y + 30.4 * step, 0, -step};
    raster.value = [=, g = raster.geotransform](int c, int r) {
        const double dx = (g[0] + g[1] * (c + 0.5) - x) / step;
        const double dy = (g[3] + g[5] * (r + 0.5) - y) / step;
        return 1000 - 10 * (dx * dx + dy * dy) / 10;
    };
    return raster;
}

/// The place of a paraboloid's top: where the parabolas through the highest post and its neighbours have
/// theirs.
geo::LatLon top_of(const test::ImportedScene& scene) {
    int column = 0;
    int row = 0;
    float highest = -std::numeric_limits<float>::infinity();
    for (int r = 1; r + 1 < scene.heights.rows(); ++r)
        for (int c = 1; c + 1 < scene.heights.columns(); ++c)
            if (scene.heights.at(c, r) > highest) {
                highest = scene.heights.at(c, r);
                column = c;
                row = r;
            }
    const auto vertex = [](double before, double at, double after) {
        return 0.5 * (before - after) / (before - 2 * at + after);
    };
    const auto at = [&](int c, int r) { return static_cast<double>(scene.heights.at(column + c, row + r)); };
    return scene.info.frame.lat_lon(
        {column + vertex(at(-1, 0), at(0, 0), at(1, 0)), row + vertex(at(0, -1), at(0, 0), at(0, 1))});
}

struct Place4 {
    const char* name;
    const char* crs;
    double x, y, step;
};

class FramesOfEveryKind : public testing::TestWithParam<Place4> {};

TEST_P(FramesOfEveryKind, ThePeakIsWhereItIs) {
    const auto& p = GetParam();
    const auto crs = Crs::parse(p.crs);
    ASSERT_TRUE(crs);
    const std::vector<Place> places{{p.x, p.y}};
    const auto operation = Operation::to_wgs84(*crs, places);
    ASSERT_TRUE(operation) << operation.error().message;
    Place truth{p.x, p.y};
    operation->forward({&truth, 1});

    const SceneFolder folder;
    SyntheticRaster raster = cone(p.crs, p.x, p.y, p.step);
    for (const char* kind : {"Area", "Point"}) {
        raster.area_or_point = kind;
        const auto scene = imported(folder, options_for(raster.write(folder / "cone.tif")));
        const auto top = top_of(scene);
        // The cone in the CRS is a paraboloid bent by the projection: its top is found to some thousandths of
        // a post.
        EXPECT_NEAR(top.lat.value, truth.y, 0.02 * scene.info.frame.step_y) << kind;
        EXPECT_NEAR(std::remainder(top.lon.value - truth.x, 360), 0, 0.02 * scene.info.frame.step_x) << kind;
        EXPECT_GE(scene.info.frame.west, -180) << kind;
        EXPECT_LT(scene.info.frame.west, 180) << kind;
    }
}

INSTANTIATE_TEST_SUITE_P(Places, FramesOfEveryKind,
                         testing::Values(Place4{"Equator", "EPSG:4326", 25, 0, 0.001},
                                         Place4{"Greenwich", "EPSG:4326", 0, 51.5, 0.001},
                                         Place4{"Antimeridian", "EPSG:4326", 180, -17, 0.001},
                                         Place4{"Turns", "EPSG:4326", 359.999, 10, 0.001},
                                         Place4{"NearThePole", "EPSG:4326", 20, 89.9, 0.001},
                                         Place4{"UtmEquator", "EPSG:32632", 500000, 0, 90},
                                         Place4{"UtmEdge", "EPSG:32632", 834000, 6000000, 30},
                                         Place4{"UtmAcross180East", "EPSG:32660", 833000, 300000, 90},
                                         Place4{"UtmAcross180West", "EPSG:32701", 167000, 8100000, 90},
                                         Place4{"PolarStereographic", "EPSG:3413", 400000, -1200000, 100},
                                         Place4{"Beyond75South", "EPSG:3031", 600000, 900000, 200},
                                         Place4{"LambertConic", "EPSG:2154", 700000, 6600000, 25},
                                         Place4{"FeetOnTheGround", "EPSG:2225", 6561667, 1640417, 100},
                                         Place4{"Nad27", "EPSG:26710", 562710, 5114985, 30},
                                         Place4{"ParisInGrads", "EPSG:4807", 1.5, 52, 0.001},
                                         Place4{"Mercator", "EPSG:3857", 0, 6700000, 50}),
                         [](const auto& place) { return std::string{place.param.name}; });

TEST(Frames, RotatedShearedAndSouthUpAgreeWithNorthUp) {
    const SceneFolder folder;
    const double x = 700000;
    const double y = 5200000;
    const auto height = [=](double easting, double northing) {
        return 500 + 200 * std::sin((easting - x) / 700) * std::cos((northing - y) / 900);
    };
    struct Kind {
        const char* name;
        std::array<double, 6> transform;
    };
    for (const Kind& kind : {Kind{"rotated", {x - 1700, 24, 18, y - 300, 18, -24}},
                             Kind{"sheared", {x - 2500, 30, 9, y + 1500, 0, -30}},
                             Kind{"south-up", {x - 1800, 30, 0, y - 1800, 0, 30}},
                             Kind{"westward", {x + 1800, -30, 0, y + 1800, 0, -30}},
                             Kind{"turned", {x - 1800, 0, 30, y - 1800, 30, 0}}}) {
        SyntheticRaster raster;
        raster.crs = "EPSG:32632";
        raster.type = GDT_Float32;
        raster.columns = raster.rows = 121;
        raster.geotransform = kind.transform;
        raster.value = [&](int c, int r) {
            const auto& g = kind.transform;
            return height(g[0] + g[1] * (c + 0.5) + g[2] * (r + 0.5),
                          g[3] + g[4] * (c + 0.5) + g[5] * (r + 0.5));
        };
        const auto scene = imported(folder, options_for(raster.write(folder / "grid.tif")));
        const auto crs = Crs::parse("EPSG:32632");
        ASSERT_TRUE(crs);
        const std::vector<Place> places{{x, y}};
        const auto operation = Operation::to_wgs84(*crs, places);
        ASSERT_TRUE(operation);
        int compared = 0;
        for (int j = -10; j <= 10; ++j)
            for (int i = -10; i <= 10; ++i) {
                Place p{x + 73.0 * i, y + 61.0 * j};
                const double truth = height(p.x, p.y);
                operation->forward({&p, 1});
                const double found = scene.height(p.y, p.x);
                if (std::isnan(found)) continue;
                ++compared;
                ASSERT_NEAR(found, truth, 0.2) << kind.name << " " << i << " " << j;
            }
        EXPECT_GT(compared, 300) << kind.name;
        EXPECT_EQ(scene.info.resampling.posts + scene.info.resampling.lost_posts, 121U * 121) << kind.name;
    }
}

}  // namespace
}  // namespace relevo::ingest
