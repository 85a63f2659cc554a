// Hard case 1: where the posts are. Peaks of known place, in frames of every kind.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ingest/reference/operation.hpp"
#include "tests/ingest/importing.hpp"
#include "tests/ingest/whole_mosaic.hpp"
#include "tests/shared_data.hpp"

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
        auto options = options_for(raster.write(folder / "cone.tif"));
        // Beside a pole a cell of this file is 600 times higher than wide: in UPS it would be 250 million
        // posts with a flat top that has no one highest post.
        if (p.y > 89) options.mosaic.target.frame = FrameChoice::geographic;
        const auto scene = imported(folder, options);
        const auto top = top_of(scene);
        // The cone in the CRS is a paraboloid bent by the projection: its top is found to some thousandths of
        // a post.
        const geo::GridFrame& frame = scene.info.frame;
        const geo::GridPosition found = frame.grid_position(top);
        const geo::GridPosition expected =
            frame.grid_position({geo::Degrees{truth.y}, geo::Degrees{truth.x}});
        EXPECT_NEAR(found.column, expected.column, 0.02) << kind;
        EXPECT_NEAR(found.row, expected.row, 0.02) << kind;
        if (frame.is_polar()) continue;
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

/// Longitude and latitude of a place in a CRS.
Place lon_lat_of(const char* crs, double x, double y) {
    const auto parsed = Crs::parse(crs);
    EXPECT_TRUE(parsed);
    const std::vector<Place> places{{x, y}};
    const auto operation = Operation::to_wgs84(*parsed, places);
    EXPECT_TRUE(operation) << operation.error().message;
    Place place{x, y};
    operation->forward({&place, 1});
    return place;
}

// A steep cone whose top is a post, and a scene with a post exactly above it: that one is the highest, at the
// same latitude and longitude to 1e-9 degree. Bilinear resampling loses 100 m of height for each post that it
// is off, so that the height tells positions to 1e-9 degree as well (4e-6 posts of 30 m, 0.4 mm). Truth:
// PROJ.
TEST(Frames, APeakIsFoundToANanodegreeInFourCrss) {
    struct Peak {
        const char* crs;
        double x, y, step;
    };
    for (const Peak& peak :
         {Peak{"EPSG:4326", 7.6586, 45.9764, 1.0 / 3600}, Peak{"EPSG:32632", 395190, 5092110, 30},
          Peak{"EPSG:3857", 852551, 5780262, 40}, Peak{"EPSG:3413", 811530, -1905320, 30}})
        for (const char* kind : {"Area", "Point"}) {
            const SceneFolder folder;
            SyntheticRaster raster;
            raster.crs = peak.crs;
            raster.type = GDT_Float64;
            raster.columns = raster.rows = 401;
            raster.geotransform = {peak.x - 200.5 * peak.step, peak.step, 0,
                                   peak.y + 200.5 * peak.step, 0,         -peak.step};
            raster.area_or_point = kind;
            raster.value = [](int c, int r) { return 4000 - 100 * std::hypot(c - 200, r - 200); };
            const auto file = raster.write(folder / "peak.tif");
            const Place truth = lon_lat_of(peak.crs, peak.x, peak.y);

            auto request = test::request_for({file});
            request.resampling = Resampling::bilinear;
            if (std::string{peak.crs} != "EPSG:4326") {  // which keeps its own posts
                // Posts at whole steps from the top; a tile of the positions' mesh begins there.
                request.target.resolution = {0.0002, 0.0002};
                request.target.crop = Bounds{truth.x - 64 * 0.0002, truth.y - 64 * 0.0002,
                                             truth.x + 64 * 0.0002, truth.y + 64 * 0.0002};
            }
            const auto scene = test::whole_mosaic(request);
            int column = 0;
            int row = 0;
            for (int r = 0; r < scene.frame.rows; ++r)
                for (int c = 0; c < scene.frame.columns; ++c)
                    if (scene.heights.at(c, r) > scene.heights.at(column, row)) {
                        column = c;
                        row = r;
                    }
            const auto top = scene.frame.lat_lon({static_cast<double>(column), static_cast<double>(row)});
            EXPECT_NEAR(top.lat.value, truth.y, 1e-9) << peak.crs << " " << kind;
            EXPECT_NEAR(top.lon.value, truth.x, 1e-9) << peak.crs << " " << kind;
            // The float next to 4000 is 0.00024 m away.
            EXPECT_NEAR(static_cast<double>(scene.heights.at(column, row)), 4000, 4e-4)
                << peak.crs << " " << kind;
        }
}

// The same, at a place near a pole and in the frame around it.
TEST(Frames, APeakIsFoundAroundAPole) {
    for (const char* kind : {"Area", "Point"}) {
        const SceneFolder folder;
        SyntheticRaster raster;
        raster.crs = "EPSG:3413";
        raster.type = GDT_Float64;
        raster.columns = raster.rows = 401;
        const double step = 30;
        const double x = 123450;
        const double y = -456780;
        raster.geotransform = {x - 200.5 * step, step, 0, y + 200.5 * step, 0, -step};
        raster.area_or_point = kind;
        raster.value = [](int c, int r) { return 4000 - 100 * std::hypot(c - 200, r - 200); };
        const auto file = raster.write(folder / "peak.tif");
        auto request = test::request_for({file});
        request.resampling = Resampling::bilinear;
        const auto open = Mosaic::open(request);
        ASSERT_TRUE(open) << open.error().message;
        ASSERT_EQ(open->frame().kind, geo::FrameKind::ups_north);
        // Every scene post near the top: its height is the cone's at its own place, by PROJ.
        const auto scene = test::read_whole(*open);
        const auto crs = Crs::parse("EPSG:3413");
        ASSERT_TRUE(crs);
        const std::vector<Place> places{{x, y}};
        const auto operation = Operation::to_wgs84(*crs, places);
        ASSERT_TRUE(operation);
        const Place truth = lon_lat_of("EPSG:3413", x, y);
        const auto top = scene.frame.grid_position({geo::Degrees{truth.y}, geo::Degrees{truth.x}});
        const int column = static_cast<int>(std::lround(top.column));
        const int row = static_cast<int>(std::lround(top.row));
        for (int r = row - 20; r <= row + 20; ++r)
            for (int c = column - 20; c <= column + 20; ++c) {
                if (std::hypot(c - top.column, r - top.row) < 3) continue;  // the tip is cut by interpolation
                const auto at = scene.frame.lat_lon({static_cast<double>(c), static_cast<double>(r)});
                Place p{at.lon.value, at.lat.value};
                operation->inverse({&p, 1});
                const double cone = 4000 - 100 * std::hypot(p.x - x, p.y - y) / step;
                // Bilinear over a cone's curvature, 100 m / (8 * 3 posts) at most; no shift, which would show
                // as 0.1 m for a thousandth of a post with opposite signs on opposite sides.
                ASSERT_NEAR(static_cast<double>(scene.heights.at(c, r)), cone, 100.0 / (4 * 3)) << kind;
            }
        const auto sides = [&](int dc, int dr) {
            double sum = 0;
            for (const int sign : {-1, 1}) {
                const auto at = scene.frame.lat_lon(
                    {static_cast<double>(column + sign * dc), static_cast<double>(row + sign * dr)});
                Place p{at.lon.value, at.lat.value};
                operation->inverse({&p, 1});
                sum += sign * (static_cast<double>(scene.heights.at(column + sign * dc, row + sign * dr)) -
                               (4000 - 100 * std::hypot(p.x - x, p.y - y) / step));
            }
            return sum;
        };
        EXPECT_NEAR(sides(100, 0), 0, 0.5) << kind;  // 0.0025 posts
        EXPECT_NEAR(sides(0, 100), 0, 0.5) << kind;
    }
}

TEST(Frames, TheWholeOfAntarcticaIsOneGridAroundThePole) {
    RELEVO_NEEDS_DATA("odd/BEDMAP_elevation.nc");
    auto request = test::request_for({test::shared_data("odd/BEDMAP_elevation.nc")});
    request.sources[0].crs = "EPSG:3031";
    const auto scene = test::whole_mosaic(request, true);
    EXPECT_EQ(scene.frame.kind, geo::FrameKind::ups_south);
    EXPECT_GT(scene.frame.columns, 1300);
    EXPECT_LT(scene.frame.columns, 1600);
    // Vinson massif stands, the Bentley trench is deep: the grid is not turned or mirrored. Truth: the
    // source's own posts there, by PROJ.
    const auto crs = Crs::parse("EPSG:3031");
    ASSERT_TRUE(crs);
    const auto source = Source::open(request.sources[0]);
    ASSERT_TRUE(source);
    const auto all = source->read({0, 0, source->columns(), source->rows()});
    ASSERT_TRUE(all);
    const std::vector<Place> places{{0, 0}, {1e6, 1e6}};
    const auto operation = Operation::to_wgs84(*crs, places);
    ASSERT_TRUE(operation);
    const auto inverse = source->posts().inverse();
    ASSERT_TRUE(inverse);
    int compared = 0;
    double squares = 0;
    for (int r = 10; r < scene.frame.rows; r += 37)
        for (int c = 10; c < scene.frame.columns; c += 41) {
            const float height = scene.heights.at(c, r);
            if (std::isnan(height)) continue;
            const auto at = scene.frame.lat_lon({static_cast<double>(c), static_cast<double>(r)});
            Place p{at.lon.value, at.lat.value};
            operation->inverse({&p, 1});
            p = inverse->at(p);
            const int i = static_cast<int>(p.x);
            const int j = static_cast<int>(p.y);
            if (p.x < 0 || p.y < 0 || i + 1 >= source->columns() || j + 1 >= source->rows()) continue;
            const double u = p.x - i;
            const double v = p.y - j;
            const double truth = (1 - v) * ((1 - u) * all->at(i, j) + u * all->at(i + 1, j)) +
                                 v * ((1 - u) * all->at(i, j + 1) + u * all->at(i + 1, j + 1));
            if (std::isnan(truth)) continue;
            squares += (static_cast<double>(height) - truth) * (static_cast<double>(height) - truth);
            ++compared;
        }
    EXPECT_GT(compared, 600);
    EXPECT_LT(std::sqrt(squares / compared), 60);  // cubic against bilinear on 5 km posts; relief of 11 km
    EXPECT_GT(scene.error.posts, 1000000U);

    request.target.frame = FrameChoice::geographic;
    const auto geographic = Mosaic::open(request);
    ASSERT_FALSE(geographic);
    EXPECT_TRUE(test::says(geographic.error().message, {"pole", "--frame ups", "--crop"}));
}

TEST(Frames, ChangeAt75Degrees) {
    const SceneFolder folder;
    const auto kind_at = [&](double north, FrameChoice choice) {
        SyntheticRaster raster;
        raster.columns = raster.rows = 101;
        raster.geotransform = {20, 0.01, 0, north, 0, -0.01};
        auto request = test::request_for({raster.write(folder / "grid.tif")});
        request.target.frame = choice;
        const auto mosaic = Mosaic::open(request);
        EXPECT_TRUE(mosaic) << mosaic.error().message;
        return mosaic ? mosaic->frame().kind : geo::FrameKind::geographic;
    };
    using geo::FrameKind;
    EXPECT_EQ(kind_at(75.4, FrameChoice::automatic), FrameKind::geographic);
    EXPECT_EQ(kind_at(75.6, FrameChoice::automatic), FrameKind::ups_north);
    EXPECT_EQ(kind_at(-74.4, FrameChoice::automatic), FrameKind::geographic);
    EXPECT_EQ(kind_at(-74.6, FrameChoice::automatic), FrameKind::ups_south);
    EXPECT_EQ(kind_at(75.6, FrameChoice::geographic), FrameKind::geographic);
    EXPECT_EQ(kind_at(50, FrameChoice::ups), FrameKind::ups_north);
}

TEST(Frames, AUpsGridKeepsItsPosts) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.crs = "EPSG:5041";
    raster.columns = 90;
    raster.rows = 70;
    raster.geotransform = {1990000, 250, 0, 2008000, 0, -250};
    const auto scene = test::whole_mosaic(test::request_for({raster.write(folder / "ups.tif")}), true);
    EXPECT_EQ(scene.frame.kind, geo::FrameKind::ups_north);
    EXPECT_EQ(scene.method, "none");
    EXPECT_EQ(scene.frame.west, 1990125);
    EXPECT_EQ(scene.frame.north, 2007875);
    ASSERT_EQ(scene.frame.columns, 90);
    for (int r = 0; r < 70; ++r)
        for (int c = 0; c < 90; ++c) ASSERT_EQ(scene.heights.at(c, r), 100 + 3 * c - 2 * r);
    EXPECT_EQ(scene.error.max_m, 0);
    EXPECT_EQ(scene.error.lost_posts, 0U);
}

// One degree, pixel-is-point, 0 to 359 and 90 to -90; rough, so that nothing is right by chance.
TEST(Frames, AllRoundTheEarthTheFirstColumnComesAgain) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = 360;
    raster.rows = 181;
    raster.geotransform = {-0.5, 1, 0, 90.5, 0, -1};
    raster.value = [](int c, int r) { return std::sin(c * 12.9898 + r * 78.233) * 3000; };
    const auto file = raster.write(folder / "earth.tif");
    auto request = test::request_for({file});
    const auto own = test::whole_mosaic(request);
    EXPECT_EQ(own.method, "none");
    ASSERT_EQ(own.frame.columns, 361);
    EXPECT_TRUE(own.frame.closes());
    request.target.resolution = {0.4, 0.4};
    const auto finer = test::whole_mosaic(request);
    EXPECT_EQ(finer.method, "cubic");
    ASSERT_EQ(finer.frame.columns, 901);
    for (const auto* scene : {&own, &finer}) {
        const int last = scene->frame.columns - 1;
        for (int r = 0; r < scene->frame.rows; ++r) {
            ASSERT_FALSE(std::isnan(scene->heights.at(0, r)));
            ASSERT_EQ(scene->heights.at(0, r), scene->heights.at(last, r)) << r;
        }
        for (const int r : {0, scene->frame.rows - 1})
            for (int c = 1; c <= last; ++c) ASSERT_EQ(scene->heights.at(c, r), scene->heights.at(0, r)) << r;
    }
    for (int r = 1; r < 180; ++r)
        for (int c = 0; c < 360; ++c)
            ASSERT_EQ(own.heights.at(c, r), static_cast<float>(std::sin(c * 12.9898 + r * 78.233) * 3000));
    // A cut across the file's own seam has no gap: the same posts as without the seam.
    request.target = {};
    request.target.crop = Bounds{-20, -30, 20, 30};
    const auto across = test::whole_mosaic(request);
    ASSERT_EQ(across.frame.columns, 41);
    EXPECT_EQ(across.frame.west, -20);
    for (int r = 0; r < across.frame.rows; ++r)
        for (int c = 0; c < 41; ++c)
            ASSERT_EQ(across.heights.at(c, r),
                      static_cast<float>(std::sin((c + 340) % 360 * 12.9898 + (r + 60) * 78.233) * 3000));
    request.target.resolution = {0.4, 0.4};
    EXPECT_EQ(test::whole_mosaic(request).valid_posts(), 101 * 151);
}

// A void next to heights of 1000 m, in a grid that is turned and sheared: nothing of -32768 anywhere.
TEST(Frames, VoidsDoNotBleedInTurnedGrids) {
    const SceneFolder folder;
    for (const auto method :
         {Resampling::cubic, Resampling::bilinear, Resampling::nearest, Resampling::average}) {
        SyntheticRaster raster;
        raster.crs = "EPSG:32632";
        raster.columns = raster.rows = 200;
        raster.geotransform = {500000, 24, 18, 5200000, 14, -26};
        raster.nodata = -32768;
        raster.value = [](int c, int r) { return (c / 20 + r / 20) % 2 == 0 ? -32768.0 : 1000.0; };
        auto request = test::request_for({raster.write(folder / "holes.tif")});
        request.resampling = method;
        if (method == Resampling::average) request.target.resolution = {0.001, 0.001};
        const auto scene = test::whole_mosaic(request);
        EXPECT_GT(scene.valid_posts(), 500);
        for (const float height : scene.heights.samples())
            if (!std::isnan(height)) {
                ASSERT_EQ(height, 1000);
            }
    }
}

}  // namespace
}  // namespace relevo::ingest
