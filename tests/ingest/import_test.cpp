// Whole imports of files made here, whose heights are known in closed form.
#include "ingest/import.hpp"

#include <cmath>
#include <random>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "geo/coordinate_text.hpp"
#include "lod/measure/point.hpp"
#include "lod/scene/scene_writer.hpp"
#include "lod/scene/sha256.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo::ingest {
namespace {

using test::imported;
using test::options_for;
using test::refused;
using test::SceneFolder;
using test::SyntheticRaster;

double rough(int column, int row) {
    return ((column * 7919 + row * 104729) % 4001) - 500;
}

TEST(Import, GeographicPostsAreKeptBitForBit) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.columns = 700;  // more than one block
    raster.rows = 530;
    raster.value = rough;
    raster.nodata = 77;
    const auto file = raster.write(folder / "rough.tif");
    auto options = options_for(file);
    options.sea.kind = lod::SeaInfo::Request::none;  // else low voids at the border get a modelled sea bed
    const auto scene = imported(folder, options);
    EXPECT_EQ(scene.info.height_type, lod::HeightType::int16);
    EXPECT_EQ(scene.info.resampling_method, "none");
    EXPECT_EQ(scene.info.resampling.max_m, 0);
    EXPECT_EQ(scene.info.resampling.lost_posts, 0U);
    ASSERT_EQ(scene.heights.columns(), 700);
    ASSERT_EQ(scene.heights.rows(), 530);
    std::uint64_t valid = 0;
    for (int r = 0; r < 530; ++r)
        for (int c = 0; c < 700; ++c) {
            const double value = rough(c, r);
            ASSERT_EQ(std::isnan(scene.heights.at(c, r)), value == 77);
            if (value == 77) continue;
            ASSERT_EQ(static_cast<double>(scene.heights.at(c, r)), value);
            ++valid;
        }
    EXPECT_EQ(scene.info.valid_posts, valid);
    EXPECT_EQ(scene.info.void_posts, 700U * 530 - valid);
    ASSERT_EQ(scene.info.sources.size(), 1U);
    const auto& source = scene.info.sources[0];
    EXPECT_EQ(source.name, "rough.tif");
    EXPECT_EQ(source.crs, "EPSG:4326");
    EXPECT_EQ(source.sha256, *lod::sha256_of_file(file));
    EXPECT_NEAR(source.step_x, 0.01, 1e-15);
    EXPECT_EQ(source.step_unit, "degree");
    EXPECT_TRUE(scene.info.vertical.assumed);
}

TEST(Import, TypesThatInt16CannotHold) {
    struct Case {
        GDALDataType type;
        double value;
        lod::HeightType expected;
    };
    for (const Case& c :
         {Case{GDT_Byte, 255, lod::HeightType::int16}, Case{GDT_UInt16, 40000, lod::HeightType::float32},
          Case{GDT_UInt16, 4000, lod::HeightType::int16}, Case{GDT_Int16, -32768, lod::HeightType::float32},
          Case{GDT_Int32, 8000, lod::HeightType::int16}, Case{GDT_Float32, 0.1F, lod::HeightType::float32},
          Case{GDT_Float64, 0.1F, lod::HeightType::float32}}) {
        const SceneFolder folder;
        SyntheticRaster raster;
        raster.type = c.type;
        raster.value = [&](int column, int) { return column == 4 ? c.value : 1; };
        const auto scene = imported(folder, options_for(raster.write(folder / "a.tif")));
        EXPECT_EQ(scene.info.height_type, c.expected) << GDALGetDataTypeName(c.type);
        EXPECT_EQ(static_cast<double>(scene.heights.at(4, 2)), c.value);
    }
}

TEST(Import, RoundingOfFloat64IsMeasuredAndSaid) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float64;
    raster.value = [](int, int) { return 1000.1; };
    const auto scene = imported(folder, options_for(raster.write(folder / "a.tif")));
    EXPECT_NEAR(scene.info.resampling.max_m, std::abs(1000.1 - static_cast<double>(1000.1F)), 1e-9);
    EXPECT_TRUE(test::says(scene.info.sources.at(0).notes, {"float64"}));
}

/// A UTM file of a function of easting and northing, and the largest difference between its scene and the
/// function at the scene's own posts. The posts' places in UTM are GeographicLib's.
struct Deviation {
    double inside = 0;  ///< at least a post inside the file's outline
    int posts = 0;
};
Deviation deviation_of_utm(const SceneFolder& folder, const test::ImportedScene& scene,
                           const SyntheticRaster& raster,
                           const std::function<double(double, double)>& height) {
    static_cast<void>(folder);
    Deviation found;
    const auto& g = raster.geotransform;
    for (int r = 0; r < scene.heights.rows(); r += 3)
        for (int c = 0; c < scene.heights.columns(); c += 3) {
            const auto text = geo::to_utm(scene.info.frame.lat_lon({double(c), double(r)}), 6);
            double easting = 0;
            double northing = 0;
            if (std::sscanf(text.c_str(), "32N %lf %lf", &easting, &northing) != 2) continue;
            const double column = (easting - g[0]) / g[1] - 0.5;
            const double row = (northing - g[3]) / g[5] - 0.5;
            if (column < 1 || row < 1 || column > raster.columns - 2 || row > raster.rows - 2) continue;
            const double difference =
                std::abs(static_cast<double>(scene.heights.at(c, r)) - height(easting, northing));
            if (!(difference <= found.inside)) found.inside = difference;
            ++found.posts;
        }
    return found;
}

SyntheticRaster utm_raster() {
    SyntheticRaster raster;
    raster.crs = "EPSG:32632";
    raster.columns = 300;
    raster.rows = 200;
    raster.type = GDT_Float64;
    raster.geotransform = {700000, 30, 0, 5200000, 0, -30};
    return raster;
}

// A 45 degree slope: a position wrong by 0.001 of a post costs 0.03 m here, and gdalwarp's default up to 3.75
// m.
TEST(Import, APlaneWarpedFromUtmIsAPlane) {
    const SceneFolder folder;
    const auto plane = [](double easting, double northing) {
        return (easting - 700000) + 0.5 * (northing - 5190000);
    };
    SyntheticRaster raster = utm_raster();
    const auto& g = raster.geotransform;
    raster.value = [&](int c, int r) { return plane(g[0] + g[1] * (c + 0.5), g[3] + g[5] * (r + 0.5)); };
    const auto file = raster.write(folder / "plane.tif");
    for (const auto method : {Resampling::cubic, Resampling::bilinear}) {
        auto options = options_for(file);
        options.mosaic.resampling = method;
        const auto scene = imported(folder, options);
        const auto found = deviation_of_utm(folder, scene, raster, plane);
        EXPECT_GT(found.posts, 5000);
        EXPECT_LE(found.inside, 0.001 * 30 * std::hypot(1, 0.5));
        EXPECT_EQ(scene.info.resampling_method, to_string(method));
        EXPECT_EQ(scene.info.height_type, lod::HeightType::float32);
    }
}

TEST(Import, ResamplingErrorIsWhatItSays) {
    const SceneFolder folder;
    SyntheticRaster raster = utm_raster();
    raster.columns = 90;
    raster.rows = 70;
    raster.value = [](int c, int r) { return 100 * std::sin(0.4 * c) * std::cos(0.3 * r); };
    const auto scene = imported(folder, options_for(raster.write(folder / "waves.tif")));
    // Brute force: every source post's place by GeographicLib, the scene's surface there.
    double squares = 0;
    double largest = 0;
    std::uint64_t count = 0;
    const auto& g = raster.geotransform;
    for (int r = 0; r < raster.rows; ++r)
        for (int c = 0; c < raster.columns; ++c) {
            const auto place = geo::parse_lat_lon(
                fmt::format("32N {:.6f} {:.6f}", g[0] + g[1] * (c + 0.5), g[3] + g[5] * (r + 0.5)));
            ASSERT_TRUE(place);
            const double difference = scene.height(place->lat.value, place->lon.value) - raster.value(c, r);
            if (std::isnan(difference)) continue;
            squares += difference * difference;
            largest = std::max(largest, std::abs(difference));
            ++count;
        }
    const auto& error = scene.info.resampling;
    EXPECT_NEAR(static_cast<double>(error.posts), static_cast<double>(count), 4);  // posts on the very border
    EXPECT_EQ(error.posts + error.lost_posts, 90U * 70);
    EXPECT_NEAR(error.max_m, largest, 0.05);
    EXPECT_NEAR(error.rms_m, std::sqrt(squares / static_cast<double>(count)), 0.01);
    EXPECT_GT(error.rms_m, 0.1);
}

TEST(Import, NodataNextToDataChangesNoHeight) {
    const SceneFolder folder;
    SyntheticRaster raster = utm_raster();
    raster.columns = raster.rows = 60;
    const auto is_void = [](int c, int r) { return (c / 7 + r / 5) % 3 == 0; };
    std::vector<test::ImportedScene> scenes;
    for (const double nodata : {-9999.0, 1e6, 0.0}) {
        raster.nodata = nodata;
        raster.value = [&](int c, int r) {
            return is_void(c, r) ? nodata : 500 + 100 * std::sin(0.5 * c + 0.2 * r);
        };
        scenes.push_back(imported(folder, options_for(raster.write(folder / "holes.tif"))));
        EXPECT_GE(scenes.back().info.height_min_m, 400);
        EXPECT_LE(scenes.back().info.height_max_m, 600);
        EXPECT_GT(scenes.back().info.void_posts, 100U);
    }
    for (std::size_t i = 0; i < scenes[0].heights.samples().size(); ++i) {
        const float first = scenes[0].heights.samples()[i];
        const float last = scenes[2].heights.samples()[i];
        ASSERT_TRUE(first == last || (std::isnan(first) && std::isnan(last)));
    }
}

TEST(Import, SameSurfaceInEveryUnit) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float64;
    struct Unit {
        const char* name;
        double metres;
    };
    for (const Unit unit : {Unit{"m", 1}, Unit{"ft", 0.3048}, Unit{"US survey foot", 1200.0 / 3937}}) {
        raster.unit = unit.name;
        raster.value = [&](int column, int row) { return (3000 + column + 0.5 * row) / unit.metres; };
        const auto scene = imported(folder, options_for(raster.write(folder / "a.tif")));
        for (int r = 0; r < raster.rows; ++r)
            for (int c = 0; c < raster.columns; ++c)
                ASSERT_NEAR(static_cast<double>(scene.heights.at(c, r)), 3000 + c + 0.5 * r, 1e-3)
                    << unit.name;
    }
}

TEST(Import, EllipsoidalHeightsHaveNoUndulation) {
    const SceneFolder folder;
    auto options = options_for(SyntheticRaster{}.write(folder / "a.tif"));
    options.mosaic.sources.front().vertical = lod::VerticalDatum::ellipsoid;
    EXPECT_TRUE(imported(folder, options).info.vertical.datum == lod::VerticalDatum::ellipsoid);
    const auto scene = lod::Scene::open(folder / "scene.relevo");
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->undulations().at(3, 3), 0);
    options.mosaic.sources.front().vertical = lod::VerticalDatum::egm96;
    imported(folder, options);
    const auto orthometric = lod::Scene::open(folder / "scene.relevo");
    ASSERT_TRUE(orthometric);
    EXPECT_NEAR(orthometric->undulations().at(3, 3), 47, 3);  // 50 N, 10 E
}

// h = H + N by the datum's own geoid, where that covers the place: a parabola, which the spline through its
// nodes is.
TEST(Import, AnotherDatumKeepsItsGeoid) {
    const SceneFolder folder;
    SyntheticRaster geoid;
    geoid.type = GDT_Float64;
    geoid.columns = geoid.rows = 33;
    geoid.geotransform = {9.9375, 0.125, 0, 52.0625, 0, -0.125};  // nodes over 10..14 E, 48..52 N
    const auto N = [](double lat, double lon) {
        return 40 + 3 * (lon - 12) - 2 * (lat - 50) + (lon - 12) * (lat - 50);
    };
    geoid.value = [&](int column, int row) { return N(52 - 0.125 * row, 10 + 0.125 * column); };
    SyntheticRaster dem;
    dem.columns = dem.rows = 400;
    dem.crs = "EPSG:4326+3855";                            // EGM2008
    dem.geotransform = {13.8, 0.001, 0, 50.3, 0, -0.001};  // the geoid ends in its middle
    auto options = options_for(dem.write(folder / "dem.tif"));
    options.mosaic.geoid = geoid.write(folder / "geoid.tif");
    const auto info = imported(folder, options).info;
    EXPECT_EQ(info.vertical.datum, lod::VerticalDatum::other);
    EXPECT_TRUE(info.vertical.geoid_known);
    const auto scene = lod::Scene::open(folder / "scene.relevo");
    ASSERT_TRUE(scene);
    lod::HeightSampler sampler(*scene);
    for (double lat = 49.95; lat < 50.25; lat += 0.0317) {
        for (double lon = 13.81; lon < 14.19; lon += 0.0213) {
            const auto point = lod::measure_point(sampler, {geo::Degrees{lat}, geo::Degrees{lon}});
            ASSERT_TRUE(point && point->H) << lat << ' ' << lon;
            ASSERT_EQ(point->N.has_value(), lon <= 14) << lon;
            if (!point->N) continue;
            EXPECT_NEAR(point->N->m, N(lat, lon), 4e-6);  // floats, of some 40 m
            EXPECT_EQ(point->h->m, point->H->m + point->N->m);
        }
    }
}

TEST(Import, StatisticsAndTheMeshsDifference) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.columns = 3;
    raster.rows = 3;
    const double z[3][3] = {{0, 4, 0}, {0, 0, -2}, {9, 0, 8}};
    raster.value = [&](int column, int row) { return z[row][column]; };
    const auto scene = imported(folder, options_for(raster.write(folder / "a.tif")));
    EXPECT_EQ(scene.info.height_min_m, -2);
    EXPECT_EQ(scene.info.height_max_m, 9);
    // South-east cell: 0, -2, 0, 8: |0 + 8 + 2 - 0| / 4.
    EXPECT_EQ(scene.info.bilinear_mesh_max_m, 2.5);
}

TEST(Import, SameInputSameBytes) {
    const SceneFolder folder;
    SyntheticRaster raster = utm_raster();
    raster.value = [](int c, int r) { return rough(c, r); };
    const auto options = options_for(raster.write(folder / "a.tif"));
    ASSERT_TRUE(import_scene(options, {folder / "one.relevo"}));
    ASSERT_TRUE(import_scene(options, {folder / "two.relevo"}));
    EXPECT_EQ(test::all_files(folder / "one.relevo"), test::all_files(folder / "two.relevo"));
}

TEST(Import, DownsamplingAverages) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.columns = raster.rows = 101;
    raster.value = [](int column, int row) { return (column + row) % 2 == 0 ? 0 : 100; };
    auto options = options_for(raster.write(folder / "a.tif"));
    options.mosaic.target.resolution = {0.04, 0.04};
    const auto scene = imported(folder, options);
    EXPECT_EQ(scene.info.resampling_method, "average");
    EXPECT_EQ(scene.heights.columns(), 26);
    for (int r = 1; r < 25; ++r)
        for (int c = 1; c < 25; ++c) ASSERT_NEAR(static_cast<double>(scene.heights.at(c, r)), 50, 1);
}

TEST(Import, PlanSaysWhatTheImportMakes) {
    const SceneFolder folder;
    SyntheticRaster raster = utm_raster();
    const auto options = options_for(raster.write(folder / "a.tif"));
    const auto plan = plan_import(options);
    ASSERT_TRUE(plan);
    const auto scene = imported(folder, options);
    EXPECT_EQ(plan->frame.columns, scene.info.frame.columns);
    EXPECT_EQ(plan->frame.rows, scene.info.frame.rows);
    EXPECT_EQ(plan->frame.west, scene.info.frame.west);
    EXPECT_EQ(plan->posts, scene.heights.samples().size());
    EXPECT_GE(3 * plan->bytes_estimate, scene.info.bytes());
    EXPECT_EQ(plan->resampling, scene.info.resampling_method);
    EXPECT_FALSE(plan->notes.empty());
}

TEST(Import, TooManyPostsAreRefused) {
    const SceneFolder folder;
    auto options = options_for(SyntheticRaster{}.write(folder / "a.tif"));
    options.max_posts = 1000;  // 20 x 10 is padded to 33 x 33
    EXPECT_TRUE(test::says(refused(folder, options), {"1089", "--max-posts", "--crop"}));
    options.max_posts = 1089;
    EXPECT_TRUE(import_scene(options, {folder / "b.relevo"}));
}

/// The visible files below a folder.
std::map<std::string, std::string> visible_files(const std::filesystem::path& folder) {
    auto files = test::all_files(folder);
    std::erase_if(files, [](const auto& file) { return file.first.starts_with('.'); });
    return files;
}

SyntheticRaster three_blocks() {
    SyntheticRaster raster;
    raster.columns = 1100;
    raster.rows = 30;
    raster.geotransform = {10, 0.001, 0, 50, 0, -0.001};
    raster.type = GDT_Float32;
    raster.value = [](int c, int r) { return rough(c, r); };
    return raster;
}

TEST(Import, StoppingLeavesTheOldSceneAsItWasAndResumes) {
    const SceneFolder folder;
    const auto options = options_for(three_blocks().write(folder / "a.tif"));
    ASSERT_TRUE(import_scene(options, {folder / "scene.relevo"}));
    const auto before = test::all_files(folder.path());
    for (const double when : {0.0, 0.2, 0.4, 0.6, 0.85, 0.93, 0.96}) {
        const auto stopped = import_scene(options, {.scene = folder / "scene.relevo", .overwrite = true},
                                          [&](double done) { return done < when; });
        ASSERT_FALSE(stopped) << when;
        EXPECT_TRUE(test::says(stopped.error().message, {"interrupted", "--resume"}));
        EXPECT_EQ(visible_files(folder.path()), before) << when;
        const auto resumed =
            import_scene(options, {.scene = folder / "scene.relevo", .overwrite = true, .resume = true});
        ASSERT_TRUE(resumed) << resumed.error().message;
        EXPECT_EQ(test::all_files(folder.path()), before) << "the same bytes, and nothing left; " << when;
    }
    EXPECT_FALSE(import_scene(options, {folder / "scene.relevo"}));  // taken
    EXPECT_EQ(test::all_files(folder.path()), before);
}

TEST(Import, OnlyTheSameJobIsResumed) {
    const SceneFolder folder;
    auto options = options_for(three_blocks().write(folder / "a.tif"));
    ASSERT_FALSE(import_scene(options, {folder / "b.relevo"}, [](double done) { return done < 0.4; }));
    options.mosaic.sources.front().height_offset = 100;
    const auto other = import_scene(options, {.scene = folder / "b.relevo", .resume = true});
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_TRUE(test::says(fmt::format("{}", fmt::join(other->notes, " ")), {"nothing to resume"}));
    ASSERT_TRUE(import_scene(options, {folder / "c.relevo"}));
    EXPECT_EQ(test::all_files(folder / "b.relevo"), test::all_files(folder / "c.relevo"));
}

TEST(Import, WhatIsLeftOfABlockIsNotTrusted) {
    const SceneFolder folder;
    const auto options = options_for(three_blocks().write(folder / "a.tif"));
    ASSERT_TRUE(import_scene(options, {folder / "whole.relevo"}));
    ASSERT_FALSE(import_scene(options, {folder / "b.relevo"}, [](double done) { return done < 0.7; }));
    int changed = 0;
    for (const auto& [name, text] : test::all_files(folder.path())) {
        if (name.find("heights/r0000-c0001") == std::string::npos || !name.starts_with(".b.")) continue;
        std::filesystem::remove(folder / name);  // not through it: drafts share their bytes
        test::replace(folder / name, text.substr(0, text.size() / 2));
        ++changed;
    }
    ASSERT_EQ(changed, 2) << "the draft and the scene's own";
    ASSERT_TRUE(import_scene(options, {.scene = folder / "b.relevo", .resume = true}));
    EXPECT_EQ(test::all_files(folder / "b.relevo"), test::all_files(folder / "whole.relevo"));
}

TEST(Import, TheSameBytesWhateverTheMemory) {
    const SceneFolder folder;
    auto options = options_for(three_blocks().write(folder / "a.tif"));
    ASSERT_TRUE(import_scene(options, {folder / "a.relevo"}));
    options.memory_bytes = plan_import(options)->memory_bytes;
    ASSERT_TRUE(import_scene(options, {folder / "b.relevo"}));
    EXPECT_EQ(test::all_files(folder / "a.relevo"), test::all_files(folder / "b.relevo"));
    options.memory_bytes = 1 << 20;
    const auto refusal = import_scene(options, {folder / "c.relevo"});
    ASSERT_FALSE(refusal);
    EXPECT_TRUE(test::says(refusal.error().message, {"MiB", "--memory"}));
}

TEST(Import, AWholeNumberThatIsTheCodeForVoidIsKept) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.nodata = 7;
    raster.value = [](int c, int r) { return c == 3 && r == 3 ? -32768 : 100 + c; };
    const auto scene = imported(folder, options_for(raster.write(folder / "a.tif")));
    EXPECT_EQ(scene.info.height_type, lod::HeightType::float32);
    EXPECT_EQ(scene.heights.at(3, 3), -32768);
}

TEST(Import, StatedLossMakesItSmallerAndIsNotExceeded) {
    const SceneFolder folder;
    SyntheticRaster raster = three_blocks();
    raster.nodata = -9999;
    raster.value = [](int c, int r) {
        return c % 97 == 0 && r > 20 ? -9999 : rough(c, r) + 0.137 * (c % 29);
    };
    auto options = options_for(raster.write(folder / "a.tif"));
    const auto exact = imported(folder, options);
    options.max_height_error_m = 0.25;
    const auto lossy = imported(folder, options);
    double largest = 0;
    for (std::size_t i = 0; i < exact.heights.samples().size(); ++i) {
        const float a = exact.heights.samples()[i];
        const float b = lossy.heights.samples()[i];
        ASSERT_EQ(std::isnan(a), std::isnan(b)) << "a void stays a void, and nothing else becomes one";
        if (!std::isnan(a)) largest = std::max(largest, std::abs(static_cast<double>(a - b)));
    }
    EXPECT_GT(largest, 0.1);
    EXPECT_LE(largest, 0.25 + 1e-4);
    EXPECT_EQ(lossy.info.max_height_error_m, 0.25);
    EXPECT_NEAR(lossy.info.resampling.max_m, largest, 1e-4) << "and it is reported";
    const auto bytes = [](const lod::SceneInfo& info) {
        std::uint64_t sum = 0;
        for (const auto& block : info.heights) sum += block.bytes;
        return sum;
    };
    EXPECT_LT(bytes(lossy.info), bytes(exact.info) * 6 / 10);
}

TEST(Import, StrangeHeightsAreNoted) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.type = GDT_Float32;
    raster.value = [](int column, int) { return column == 3 ? -99999 : 10; };
    const auto scene = imported(folder, options_for(raster.write(folder / "a.tif")));
    EXPECT_TRUE(test::says(scene.info.sources.at(0).notes, {"--nodata"}));
}

}  // namespace
}  // namespace relevo::ingest
