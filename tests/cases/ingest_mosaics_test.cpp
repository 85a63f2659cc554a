// Many sources as one grid: real tiles that adjoin, and made ones of which every post is known.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <set>

#include <gtest/gtest.h>

#include "tests/ingest/importing.hpp"
#include "tests/ingest/whole_mosaic.hpp"
#include "tests/shared_data.hpp"

namespace relevo::ingest {
namespace {

using test::request_for;
using test::same;
using test::SceneFolder;
using test::shared_data;
using test::SyntheticRaster;
using test::whole_mosaic;
using test::WholeMosaic;

/// All values of a raster as GDAL gives them, void = NaN: the truth for posts that are kept.
struct GdalRaster {
    int columns = 0;
    int rows = 0;
    std::array<double, 6> transform{};
    std::vector<double> values;

    explicit GdalRaster(const std::filesystem::path& file) {
        GDALAllRegister();
        const DatasetPtr dataset{GDALDataset::Open(file.c_str())};
        EXPECT_TRUE(dataset) << file;
        if (!dataset) return;
        columns = dataset->GetRasterXSize();
        rows = dataset->GetRasterYSize();
        dataset->GetGeoTransform(transform.data());
        values.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
        GDALRasterBand* band = dataset->GetRasterBand(1);
        EXPECT_EQ(band->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows, GDT_Float64, 0,
                                 0, nullptr),
                  CE_None);
        int has = 0;
        const double nodata = band->GetNoDataValue(&has);
        for (double& v : values)
            if (has != 0 && v == nodata) v = std::nan("");
    }

    double at(int column, int row) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
    /// Longitude (easting) and latitude (northing) of a post.
    double x(int column) const { return transform[0] + transform[1] * (column + 0.5); }
    double y(int row) const { return transform[3] + transform[5] * (row + 0.5); }
};

/// Every post of the files is in the scene, where it belongs, as it is.
void expect_kept(const WholeMosaic& scene, const std::vector<std::filesystem::path>& files) {
    EXPECT_EQ(scene.method, "none");
    for (std::size_t i = 0; i < files.size(); ++i) {
        const GdalRaster truth{files[i]};
        int valid = 0;
        for (int r = 0; r < truth.rows; ++r)
            for (int c = 0; c < truth.columns; ++c) {
                if (std::isnan(truth.at(c, r))) continue;
                ++valid;
                const auto p =
                    scene.frame.grid_position({geo::Degrees{truth.y(r)}, geo::Degrees{truth.x(c)}});
                ASSERT_NEAR(p.column, std::round(p.column), 1e-3);
                ASSERT_NEAR(p.row, std::round(p.row), 1e-3);
                const int column = static_cast<int>(std::lround(p.column));
                const int row = static_cast<int>(std::lround(p.row));
                ASSERT_EQ(scene.heights.at(column, row), static_cast<float>(truth.at(c, r))) << c << " " << r;
                ASSERT_EQ(scene.marks.at(column, row).post_class(), lod::PostClass::land);
            }
        EXPECT_GT(valid, 0) << files[i];
    }
}

TEST(Mosaics, TilesThatShareARow) {
    RELEVO_NEEDS_DATA("mosaic/pyrenees");
    const auto north = shared_data("mosaic/pyrenees/N42E001.hgt.zip");
    const auto south = shared_data("mosaic/pyrenees/N41E001.hgt.zip");
    const auto scene = whole_mosaic(request_for({south, north}), true);
    EXPECT_EQ(scene.frame.columns, 1201);
    EXPECT_EQ(scene.frame.rows, 2401);  // 2 x 1201 less the row that they share
    EXPECT_NEAR(scene.frame.north, 43, 1e-12);
    EXPECT_TRUE(scene.fits_int16);
    expect_kept(scene, {north, south});
    EXPECT_EQ(scene.error.max_m, 0);
    EXPECT_EQ(scene.error.lost_posts, 0U);
    EXPECT_EQ(scene.error.posts, static_cast<std::uint64_t>(scene.valid_posts()));
    // The shared row is the first input's.
    EXPECT_EQ(scene.marks.at(600, 1200).source(), 0);
    EXPECT_EQ(scene.marks.at(600, 1199).source(), 1);
}

TEST(Mosaics, TilesThatShareAColumnOneOfThemZipped) {
    RELEVO_NEEDS_DATA("mosaic/gabon");
    const auto west = shared_data("mosaic/gabon/N00E010.hgt");
    const auto east = shared_data("mosaic/gabon/N00E011.hgt.zip");
    const auto scene = whole_mosaic(request_for({shared_data("mosaic/gabon")}));  // the folder
    EXPECT_EQ(scene.sources.size(), 2U);
    EXPECT_EQ(scene.frame.columns, 2401);
    EXPECT_EQ(scene.frame.rows, 1201);
    expect_kept(scene, {west, east});
}

TEST(Mosaics, MissingCellsAreVoid) {
    RELEVO_NEEDS_DATA("mosaic/california");
    const auto folder = shared_data("mosaic/california");
    const auto scene = whole_mosaic(request_for({folder}));
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".dt0") files.push_back(entry.path());
    ASSERT_EQ(files.size(), 12U);
    EXPECT_EQ(scene.sources.size(), 12U);
    EXPECT_EQ(scene.frame.columns, 4 * 120 + 1);
    EXPECT_EQ(scene.frame.rows, 4 * 120 + 1);
    expect_kept(scene, files);
    // The middle of w125_n36, which is not there.
    EXPECT_TRUE(std::isnan(scene.at({geo::Degrees{36.5}, geo::Degrees{-124.5}})));
    EXPECT_FALSE(std::isnan(scene.at({geo::Degrees{36.5}, geo::Degrees{-121.5}})));
}

// Four projected tiles without a shared row: resampling must not see where one ends. Truth: the same tiles
// joined by their VRT.
TEST(Mosaics, ProjectedTilesWithoutASharedRowAreTheirVrt) {
    RELEVO_NEEDS_DATA("mosaic/logan");
    std::vector<std::filesystem::path> tiles;
    for (const char* name : {"loganvrt_0.tif", "loganvrt_1.tif", "loganvrt_2.tif", "loganvrt_3.tif"})
        tiles.push_back(shared_data("mosaic/logan") / name);
    const auto joined = whole_mosaic(request_for({shared_data("mosaic/logan/logan.vrt")}), true);
    const auto scene = whole_mosaic(request_for(tiles), true);
    EXPECT_EQ(scene.method, "cubic");
    ASSERT_EQ(scene.frame.columns, joined.frame.columns);
    ASSERT_EQ(scene.frame.rows, joined.frame.rows);
    // Places come through each file's own georeference, which rounds.
    EXPECT_NEAR(scene.frame.west, joined.frame.west, 1e-9);
    EXPECT_NEAR(scene.frame.step_x, joined.frame.step_x, 1e-12);
    float largest = 0;
    for (std::size_t i = 0; i < scene.heights.samples().size(); ++i) {
        const float a = scene.heights.samples()[i];
        const float b = joined.heights.samples()[i];
        ASSERT_EQ(std::isnan(a), std::isnan(b)) << i;
        if (!std::isnan(a)) largest = std::max(largest, std::abs(a - b));
    }
    EXPECT_LT(largest, 0.02F);  // of slopes of 30 m a post, 0.001 of a post
    EXPECT_EQ(scene.error.posts, joined.error.posts);
    EXPECT_NEAR(scene.error.rms_m, joined.error.rms_m, 1e-3);
    std::set<int> sources;
    for (const auto& mark : scene.marks.samples())
        if (!mark.is_void()) sources.insert(mark.source());
    EXPECT_EQ(sources, (std::set<int>{0, 1, 2, 3}));
}

/// A surface over degrees that no interpolation makes exactly.
double ground(double lon, double lat) {
    return 800 + 400 * std::sin(lon * 37) * std::cos(lat * 29) + 30 * std::sin(lon * 411 + lat * 293);
}

/// A geographic tile of the ground: posts from (west, north) on, with exact steps.
SyntheticRaster tile(double west, double north, double step, int columns, int rows) {
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = columns;
    raster.rows = rows;
    raster.geotransform = {west - 0.5 * step, step, 0, north + 0.5 * step, 0, -step};
    raster.value = [=](int c, int r) { return ground(west + step * c, north - step * r); };
    return raster;
}

constexpr double kStep = 1.0 / 1024;  // degrees; exact, so that tiles' georeferences do not round

// As Copernicus cuts its tiles. Truth: the same posts in one file.
TEST(Mosaics, TilesWithoutASharedRowAreOneRaster) {
    const SceneFolder folder;
    std::vector<std::filesystem::path> tiles;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i)
            tiles.push_back(tile(10 + 200 * i * kStep, 50 - 150 * j * kStep, kStep, 200, 150)
                                .write(folder / ("t" + std::to_string(i) + std::to_string(j) + ".tif")));
    const auto one = tile(10, 50, kStep, 600, 300).write(folder / "one.tif");
    for (const double step : {kStep, 0.73 * kStep, 3.1 * kStep}) {
        auto request = request_for(tiles);
        auto truth_request = request_for({one});
        request.target.resolution = truth_request.target.resolution = {step, step};
        const auto scene = whole_mosaic(request, true);
        const auto truth = whole_mosaic(truth_request, true);
        EXPECT_EQ(scene.method, step == kStep ? "none" : step < kStep ? "cubic" : "average");
        ASSERT_EQ(scene.frame.columns, truth.frame.columns);
        ASSERT_EQ(scene.frame.rows, truth.frame.rows);
        for (std::size_t i = 0; i < scene.heights.samples().size(); ++i)
            ASSERT_TRUE(same(scene.heights.samples()[i], truth.heights.samples()[i])) << step << " " << i;
        EXPECT_EQ(scene.error.posts, truth.error.posts);
        EXPECT_EQ(scene.error.max_m, truth.error.max_m);
        // Each post's source is the tile that holds the nearest source post.
        for (int r = 0; r < scene.frame.rows; r += 7)
            for (int c = 0; c < scene.frame.columns; c += 5) {
                if (scene.marks.at(c, r).is_void()) continue;
                const double x = (scene.frame.west + c * scene.frame.step_x - 10) / kStep;
                const double y = (50 - scene.frame.north + r * scene.frame.step_y) / kStep;
                if (std::abs(x - std::floor(x) - 0.5) < 1e-6 || std::abs(y - std::floor(y) - 0.5) < 1e-6)
                    continue;
                const int expected = std::min(static_cast<int>(std::lround(x)) / 200, 2) +
                                     3 * std::min(static_cast<int>(std::lround(y)) / 150, 1);
                ASSERT_EQ(scene.marks.at(c, r).source(), expected) << c << " " << r;
            }
    }
}

TEST(Mosaics, FinestWinsAndOrderMayDecide) {
    const SceneFolder folder;
    const auto plain = [](double west, double north, double step, int count, double height) {
        auto raster = tile(west, north, step, count, count);
        raster.value = [=](int, int) { return height; };
        return raster;
    };
    const auto coarse = plain(10, 50, 4 * kStep, 51, 100).write(folder / "coarse.tif");
    auto with_void = plain(10 + 40 * kStep, 50 - 40 * kStep, kStep, 81, 200);
    with_void.nodata = -9999;
    with_void.value = [](int c, int r) { return c >= 30 && c < 50 && r >= 30 && r < 50 ? -9999.0 : 200.0; };
    const auto fine = with_void.write(folder / "fine.tif");
    const auto again = plain(10 + 100 * kStep, 50 - 40 * kStep, kStep, 81, 300).write(folder / "again.tif");

    const auto finest = whole_mosaic(request_for({coarse, fine, again}));
    EXPECT_EQ(finest.frame.columns, 201);
    EXPECT_EQ(finest.frame.step_x, kStep);
    EXPECT_EQ(finest.heights.at(10, 10), 100);
    EXPECT_EQ(finest.heights.at(50, 50), 200);
    EXPECT_EQ(finest.heights.at(80, 80), 100);   // through the finer one's hole
    EXPECT_EQ(finest.heights.at(110, 50), 200);  // both fine ones: the first of the inputs
    EXPECT_EQ(finest.heights.at(130, 50), 300);
    EXPECT_EQ(finest.marks.at(10, 10).source(), 0);
    EXPECT_EQ(finest.marks.at(50, 50).source(), 1);
    EXPECT_EQ(finest.marks.at(80, 80).source(), 0);
    EXPECT_EQ(finest.marks.at(130, 50).source(), 2);
    EXPECT_EQ(whole_mosaic(request_for({coarse, again, fine})).heights.at(110, 50), 300);

    auto request = request_for({coarse, fine, again});
    request.priority = Priority::order;
    const auto ordered = whole_mosaic(request);
    EXPECT_EQ(ordered.frame.step_x, kStep);  // no post is lost all the same
    EXPECT_EQ(ordered.heights.at(50, 50), 100);
    EXPECT_EQ(ordered.heights.at(130, 50), 100);
    request = request_for({again, coarse, fine});
    request.priority = Priority::order;
    const auto between = whole_mosaic(request);
    EXPECT_EQ(between.heights.at(130, 50), 300);
    EXPECT_EQ(between.heights.at(50, 50), 100);
}

// Somebody's UTM warp of the tile lies around it: the tile's own posts stay, bit for bit.
TEST(Mosaics, MixedStepsAndCrss) {
    RELEVO_NEEDS_DATA("odd/N00E010_utm.tif");
    const auto own = shared_data("mosaic/gabon/N00E010.hgt");
    const auto warped = shared_data("odd/N00E010_utm.tif");
    for (const bool own_first : {true, false}) {
        const auto scene =
            whole_mosaic(own_first ? request_for({own, warped}) : request_for({warped, own}), own_first);
        EXPECT_NEAR(scene.frame.step_x, 1.0 / 1200, 1e-12);
        const GdalRaster truth{own};
        const auto first = scene.frame.grid_position({geo::Degrees{truth.y(0)}, geo::Degrees{truth.x(0)}});
        const int left = static_cast<int>(std::lround(first.column));
        const int top = static_cast<int>(std::lround(first.row));
        EXPECT_NEAR(first.column, left, 1e-6);
        for (int r = 0; r < truth.rows; ++r)
            for (int c = 0; c < truth.columns; ++c) {
                if (std::isnan(truth.at(c, r))) continue;
                const auto mark = scene.marks.at(left + c, top + r);
                const bool from_own = mark.source() == (own_first ? 0 : 1);
                if (own_first) {
                    ASSERT_TRUE(from_own) << c << " " << r;
                }
                if (from_own) {
                    ASSERT_EQ(scene.heights.at(left + c, top + r), static_cast<float>(truth.at(c, r)));
                }
            }
    }
}

// H + N of the one - N of the other. Truth: the same ellipsoidal surface, with N by GeographicLib's way of
// geo::Geoid, whose accuracy its own tests show.
TEST(Mosaics, MixedDatumsAreBroughtToOne) {
    const SceneFolder folder;
    const auto geoid = geo::Geoid::egm96();
    ASSERT_TRUE(geoid);
    const auto undulation = [&](double lon, double lat) {
        return geoid->undulation({geo::Degrees{lat}, geo::Degrees{lon}}).m;
    };
    auto west = tile(10, 50, kStep, 201, 201);
    west.crs = "EPSG:4326+5773";
    auto east = tile(10 + 200 * kStep, 50, kStep, 201, 201);
    east.crs = "EPSG:4979";
    east.value = [=](int c, int r) {
        const double lon = 10 + (200 + c) * kStep;
        const double lat = 50 - r * kStep;
        return ground(lon, lat) + undulation(lon, lat);
    };
    const auto a = west.write(folder / "msl.tif");
    const auto b = east.write(folder / "ellipsoid.tif");
    const auto msl = whole_mosaic(request_for({a, b}), true);
    EXPECT_EQ(msl.vertical.datum, lod::VerticalDatum::egm96);
    EXPECT_FALSE(msl.fits_int16);
    ASSERT_EQ(msl.frame.columns, 401);
    for (int r = 0; r < 201; r += 3)
        for (int c = 0; c < 401; ++c)
            ASSERT_NEAR(static_cast<double>(msl.heights.at(c, r)), ground(10 + c * kStep, 50 - r * kStep),
                        1e-3)
                << c << " " << r;
    EXPECT_LT(msl.error.max_m, 1e-3);
    EXPECT_EQ(msl.error.lost_posts, 0U);

    auto request = request_for({a, b});
    request.datum = lod::VerticalReference{lod::VerticalDatum::ellipsoid, "WGS 84 ellipsoid", false};
    const auto ellipsoidal = whole_mosaic(request);
    EXPECT_EQ(ellipsoidal.vertical.datum, lod::VerticalDatum::ellipsoid);
    for (int r = 0; r < 201; r += 3)
        for (int c = 0; c < 401; ++c) {
            const double lon = 10 + c * kStep;
            const double lat = 50 - r * kStep;
            ASSERT_NEAR(static_cast<double>(ellipsoidal.heights.at(c, r)),
                        ground(lon, lat) + undulation(lon, lat), 1e-3);
        }
}

TEST(Mosaics, ADatumWithoutItsGeoidIsAnErrorThatNamesTheGrid) {
    const SceneFolder folder;
    auto west = tile(10, 50, kStep, 21, 21);
    west.crs = "EPSG:4326+5773";
    auto east = tile(10 + 20 * kStep, 50, kStep, 21, 21);
    east.crs = "EPSG:4326+3855";  // EGM2008
    const auto mosaic =
        Mosaic::open(request_for({west.write(folder / "a.tif"), east.write(folder / "b.tif")}));
    ASSERT_FALSE(mosaic);
    EXPECT_EQ(mosaic.error().kind, ErrorKind::input);
    EXPECT_TRUE(test::says(mosaic.error().message, {"b.tif", "EGM2008", "--geoid"}));
    // Nothing to convert: nothing is missing.
    EXPECT_TRUE(Mosaic::open(request_for({folder / "b.tif"})));
}

TEST(Mosaics, NeighboursAcrossTheAntimeridian) {
    const SceneFolder folder;
    auto west = tile(180 - 100 * kStep, -16, kStep, 101, 80);  // to 180 E
    auto east = tile(-180, -16, kStep, 101, 80);               // from 180 W
    east.value = [](int c, int r) { return ground(180 + c * kStep, -16 - r * kStep); };
    const auto a = west.write(folder / "w.tif");
    const auto b = east.write(folder / "e.tif");
    for (const bool west_first : {true, false}) {
        const auto scene = whole_mosaic(west_first ? request_for({a, b}) : request_for({b, a}), true);
        EXPECT_EQ(scene.method, "none");
        EXPECT_EQ(scene.frame.west, 180 - 100 * kStep);
        ASSERT_EQ(scene.frame.columns, 201);
        for (int r = 0; r < 80; ++r)
            for (int c = 0; c < 201; ++c)
                ASSERT_EQ(scene.heights.at(c, r),
                          static_cast<float>(ground(180 + (c - 100) * kStep, -16 - r * kStep)))
                    << c << " " << r;
        EXPECT_EQ(scene.error.max_m, 0);
        EXPECT_EQ(scene.error.lost_posts, 0U);
    }
    // Resampled, too, there is no gap at the meridian, also where a full turn is no whole number of steps.
    // Truth: the same posts in one file.
    for (const double step : {kStep, 0.0007}) {
        auto other = tile(-180, -16, step, 101, 80);
        other.value = [=](int c, int r) { return ground(180 + c * step, -16 - r * step); };
        auto request = request_for({tile(180 - 100 * step, -16, step, 101, 80).write(folder / "w.tif"),
                                    other.write(folder / "e.tif")});
        auto truth_request =
            request_for({tile(180 - 100 * step, -16, step, 201, 80).write(folder / "one.tif")});
        request.target.resolution = truth_request.target.resolution = {0.7 * step, 0.7 * step};
        const auto scene = whole_mosaic(request);
        const auto truth = whole_mosaic(truth_request);
        EXPECT_EQ(scene.method, "cubic");
        ASSERT_EQ(scene.heights.samples().size(), truth.heights.samples().size());
        for (std::size_t i = 0; i < truth.heights.samples().size(); ++i) {
            ASSERT_FALSE(std::isnan(scene.heights.samples()[i])) << step << " " << i;
            ASSERT_NEAR(scene.heights.samples()[i], truth.heights.samples()[i], 1e-3) << step << " " << i;
        }
    }
}

TEST(Mosaics, FeatherLeavesNoStep) {
    const SceneFolder folder;
    auto coarse = tile(10, 50, 2 * kStep, 201, 201);
    coarse.value = [](int, int) { return 100.0; };
    auto fine = tile(10 + 100 * kStep, 50 - 100 * kStep, kStep, 201, 201);
    fine.nodata = -9999;
    fine.value = [](int c, int r) {
        return (c - 120) * (c - 120) + (r - 90) * (r - 90) < 400 ? -9999 : 150.0;
    };
    auto request = request_for({coarse.write(folder / "coarse.tif"), fine.write(folder / "fine.tif")});
    const auto hard = whole_mosaic(request);
    request.feather_m = 2000;
    const auto soft = whole_mosaic(request);
    const auto largest_step = [](const WholeMosaic& scene) {
        float largest = 0;
        for (int r = 0; r + 1 < scene.frame.rows; ++r)
            for (int c = 0; c + 1 < scene.frame.columns; ++c)
                largest = std::max({largest, std::abs(scene.heights.at(c + 1, r) - scene.heights.at(c, r)),
                                    std::abs(scene.heights.at(c, r + 1) - scene.heights.at(c, r))});
        return largest;
    };
    EXPECT_EQ(largest_step(hard), 50);
    // 50 m over 2000 m, at most a post's 109 m of it at once.
    EXPECT_LT(largest_step(soft), 50 * 109.0F / 2000 + 0.01F);
    EXPECT_EQ(soft.valid_posts(), hard.valid_posts());
    EXPECT_EQ(soft.heights.at(10, 10), 100);
    EXPECT_EQ(soft.heights.at(260, 260), 150);  // 40 posts, 2.8 km and more, inside
    EXPECT_EQ(soft.heights.at(220, 190), 100);  // in the hole
    // Weights by brute force: the distance to the nearest post that only the coarse one has.
    const auto spacing = soft.frame.spacing({0, 192 + 32.0});
    for (const auto& [column, row] : {std::pair{110, 200}, std::pair{245, 200}, std::pair{200, 215}}) {
        double nearest = 1e9;
        for (int r = 0; r < hard.frame.rows; ++r)
            for (int c = 0; c < hard.frame.columns; ++c)
                if (hard.heights.at(c, r) == 100)
                    nearest = std::min(
                        nearest, std::hypot((c - column) * spacing.column_m, (r - row) * spacing.row_m));
        const double weight = std::min(nearest / 2000, 1.0);
        EXPECT_NEAR(static_cast<double>(soft.heights.at(column, row)), 100 + 50 * weight, 1e-3)
            << column << " " << row;
    }
    request.feather_m = 40000;
    const auto wide = Mosaic::open(request);
    ASSERT_FALSE(wide);
    EXPECT_TRUE(test::says(wide.error().message, {"--feather", "256"}));
}

int open_files() {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        (void)entry;
        ++count;
    }
    return count;
}

TEST(Mosaics, ThousandsOfTilesWithFewOpenFiles) {
    const SceneFolder folder;
    constexpr int kAcross = 60;
    constexpr int kDown = 50;
    constexpr int kSide = 20;
    std::filesystem::create_directory(folder / "tiles");
    for (int j = 0; j < kDown; ++j)
        for (int i = 0; i < kAcross; ++i)
            tile(10 + i * kSide * kStep, 50 - j * kSide * kStep, kStep, kSide, kSide)
                .write(folder / "tiles" / ("t" + std::to_string(j * kAcross + i) + ".tif"));
    const int before = open_files();
    const std::clock_t start = std::clock();  // of the processor, so that a busy machine does not count
    const auto mosaic = Mosaic::open(request_for({folder / "tiles"}));
    ASSERT_TRUE(mosaic) << mosaic.error().message;
    std::atomic<int> most = open_files();
    const auto& frame = mosaic->frame();
    ASSERT_EQ(frame.columns, kAcross * kSide);
    ASSERT_EQ(frame.rows, kDown * kSide);
    const auto done = test::for_each_block_of(frame, [&](Window w) -> Result<void> {
        const auto posts = mosaic->read(w);
        if (!posts) return posts.error();
        most = std::max(most.load(), open_files());
        for (int r = 0; r < w.rows; ++r)
            for (int c = 0; c < w.columns; ++c) {
                const float truth =
                    static_cast<float>(ground(10 + (w.column + c) * kStep, 50 - (w.row + r) * kStep));
                if (posts->heights.at(c, r) != truth)
                    return Error{ErrorKind::internal, "a post differs: " + std::to_string(w.column + c)};
            }
        return {};
    });
    EXPECT_TRUE(done) << done.error().message;
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(most - before, 64 + 16);
    EXPECT_LT(seconds, 60);  // each is opened twice, at about 1 ms; 10 s in all
    std::printf("3000 tiles: %.1f s of processor time, %d files open at most\n", seconds, most - before);
}

TEST(Mosaics, ATileThatVanishesIsNamed) {
    const SceneFolder folder;
    std::vector<std::filesystem::path> tiles;
    for (int i = 0; i < 70; ++i)
        tiles.push_back(
            tile(10 + i * 20 * kStep, 50, kStep, 20, 20).write(folder / ("t" + std::to_string(i) + ".tif")));
    const auto mosaic = Mosaic::open(request_for(tiles));
    ASSERT_TRUE(mosaic);
    std::filesystem::remove(folder / "t69.tif");  // not among those that stayed open
    const auto posts = mosaic->read({1024, 0, mosaic->frame().columns - 1024, 20});
    ASSERT_FALSE(posts);
    EXPECT_EQ(posts.error().kind, ErrorKind::input);
    EXPECT_TRUE(test::says(posts.error().message, {"t69.tif"}));
}

}  // namespace
}  // namespace relevo::ingest
