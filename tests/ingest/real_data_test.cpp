// Real files: kept posts against what GDAL reads, warped ones against each other.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/ingest/importing.hpp"
#include "tests/shared_data.hpp"

namespace relevo::ingest {
namespace {

using test::imported;
using test::options_for;
using test::refused;
using test::SceneFolder;
using test::shared_data;

class KeptPosts : public testing::TestWithParam<const char*> {};

TEST_P(KeptPosts, AreWhatGdalReads) {
    RELEVO_NEEDS_DATA(GetParam());
    const SceneFolder folder;
    auto options = options_for(shared_data(GetParam()));
    const bool has_crs = std::string{GetParam()}.find(".nc") == std::string::npos;
    if (!has_crs) options.mosaic.sources.front().crs = "EPSG:4326";
    options.sea.kind = lod::SeaInfo::Request::none;  // else sea that is nodata gets a modelled bed
    const auto scene = imported(folder, options);
    ASSERT_EQ(scene.info.resampling_method, "none");
    EXPECT_EQ(scene.info.height_type, lod::HeightType::int16);

    const DatasetPtr truth{GDALDataset::Open(shared_data(GetParam()).c_str())};
    ASSERT_TRUE(truth);
    const int columns = truth->GetRasterXSize();
    const int rows = truth->GetRasterYSize();
    ASSERT_EQ(scene.heights.columns(), columns);
    ASSERT_EQ(scene.heights.rows(), rows);
    std::vector<std::int16_t> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    ASSERT_EQ(truth->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows,
                                                GDT_Int16, 0, 0, nullptr),
              CE_None);
    const auto nodata = static_cast<std::int16_t>(truth->GetRasterBand(1)->GetNoDataValue());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float height = scene.heights.samples()[i];
        ASSERT_EQ(std::isnan(height), values[i] == nodata) << i;
        if (values[i] != nodata) {
            ASSERT_EQ(height, static_cast<float>(values[i])) << i;
        }
    }
    std::array<double, 6> g{};
    truth->GetGeoTransform(g.data());
    EXPECT_EQ(scene.info.frame.west, g[0] + 0.5 * g[1]);
    EXPECT_EQ(scene.info.frame.north, g[3] + 0.5 * g[5]);
    EXPECT_EQ(scene.info.frame.step_x, g[1]);
}

INSTANTIATE_TEST_SUITE_P(Catalog, KeptPosts,
                         testing::Values("coast/N43E007.hgt.zip", "coast/netherlands_30s.nc",
                                         "coast/france_italy_etopo2.nc", "mountains/mt_everest_90m.tif",
                                         "mountains/mt_rainier_90m.tif", "mountains/baltoro.tif",
                                         "mosaic/gabon/N00E010.hgt", "mosaic/california/w122_n38.dt0",
                                         "odd/netherlands_cog_egm96.tif"),
                         [](const auto& name) {
                             std::string plain;
                             for (const char c : std::string{name.param})
                                 plain += std::isalnum(c) != 0 ? c : '_';
                             return plain;
                         });

TEST(RealData, DeclaredDatumIsNotAssumed) {
    RELEVO_NEEDS_DATA("odd/netherlands_cog_egm96.tif");
    const auto plan = plan_import(options_for(shared_data("odd/netherlands_cog_egm96.tif")));
    ASSERT_TRUE(plan);
    EXPECT_FALSE(plan->vertical.assumed);
    EXPECT_EQ(plan->vertical.datum, lod::VerticalDatum::egm96);
}

TEST(RealData, PixelIsPointAndPixelIsAreaLoadAtTheSamePlace) {
    RELEVO_NEEDS_DATA("odd/st_helens_point.tif");
    const SceneFolder folder;
    const auto point = imported(folder, options_for(shared_data("odd/st_helens_point.tif")));
    const auto area = imported(folder, options_for(shared_data("odd/st_helens_area.tif")));
    EXPECT_EQ(point.info.frame.west, area.info.frame.west);
    EXPECT_EQ(point.info.frame.north, area.info.frame.north);
    ASSERT_EQ(point.heights.samples().size(), area.heights.samples().size());
    for (std::size_t i = 0; i < point.heights.samples().size(); ++i) {
        const float a = point.heights.samples()[i];
        const float b = area.heights.samples()[i];
        ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    }
}

// NAD27 needs a shift grid for its best operation; without it a Helmert transformation of 7 m stands in, and
// that is said.
TEST(RealData, SaintHelensIsShiftedFromNad27) {
    RELEVO_NEEDS_DATA("odd/SainteHelens.dem");
    const auto plan = plan_import(options_for(shared_data("odd/SainteHelens.dem")));
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_EQ(plan->sources[0].crs, "EPSG:26710");
    ASSERT_TRUE(plan->sources[0].operation_accuracy_m);
    EXPECT_TRUE(*plan->sources[0].operation_accuracy_m < 3 || !plan->sources[0].operation_note.empty());
    EXPECT_NEAR(plan->frame.north, 46.2510 - 0.0002, 0.0005);
}

// Somebody's warp to UTM has smoothed the heights, but must not have moved them, nor may ours: the shift at
// which the two scenes agree best is where the parabola through the mean squares at three shifts has its
// bottom.
TEST(RealData, UtmCopyIsWhereItsHgtIs) {
    RELEVO_NEEDS_DATA("odd/N00E010_utm.tif");
    const SceneFolder folder;
    const auto warped = imported(folder, options_for(shared_data("odd/N00E010_utm.tif")));
    const auto own = imported(folder, options_for(shared_data("mosaic/gabon/N00E010.hgt")));
    const auto mean_square = [&](double east, double south) {
        double squares = 0;
        int count = 0;
        for (int r = 100; r < 1100; r += 7)
            for (int c = 100; c < 1100; c += 7) {
                const auto place = own.info.frame.lat_lon({c + east, r + south});
                const double difference = warped.height(place.lat.value, place.lon.value) -
                                          static_cast<double>(own.heights.at(c, r));
                if (std::isnan(difference)) continue;
                squares += difference * difference;
                ++count;
            }
        EXPECT_GT(count, 20000);
        return squares / count;
    };
    const auto bottom = [](double before, double at, double after) {
        return 0.5 * (before - after) / (before - 2 * at + after);
    };
    const double here = mean_square(0, 0);
    EXPECT_LT(std::sqrt(here), 8);  // of heights from 1 to 1005 m, smoothed twice
    EXPECT_NEAR(bottom(mean_square(-1, 0), here, mean_square(1, 0)), 0, 0.1);
    EXPECT_NEAR(bottom(mean_square(0, -1), here, mean_square(0, 1)), 0, 0.1);
}

TEST(RealData, RefusalsWithTheirRemedies) {
    RELEVO_NEEDS_DATA("odd/santa_barbara_airport.tif");
    const SceneFolder folder;
    auto airport = options_for(shared_data("odd/santa_barbara_airport.tif"));
    EXPECT_TRUE(
        test::says(refused(folder, airport), {"santa_barbara_airport.tif", "--crs EPSG:4326", "corrupt"}));
    airport.mosaic.sources[0].crs = "EPSG:4326";
    airport.mosaic.sources[0].bounds = Bounds{-119.8337, 34.4293, -119.8182, 34.4448};
    const auto scene = imported(folder, airport);
    EXPECT_NEAR(scene.info.height_min_m, 2.5, 0.5);
    EXPECT_NEAR(scene.info.height_max_m, 20.7, 0.5);

    EXPECT_TRUE(test::says(refused(folder, options_for(shared_data("odd/fuji_terrainrgb.png"))), {"image"}));
    EXPECT_TRUE(
        test::says(refused(folder, options_for(shared_data("imagery/everest_landsat_rgb.tif"))), {"image"}));

    auto antarctica = options_for(shared_data("odd/BEDMAP_elevation.nc"));
    EXPECT_TRUE(test::says(refused(folder, antarctica), {"--crs"}));
    antarctica.mosaic.sources[0].crs = "EPSG:3031";
    const auto whole = imported(folder, antarctica);
    EXPECT_EQ(whole.info.frame.kind, geo::FrameKind::ups_south) << "the pole is inside";
    EXPECT_GT(whole.info.valid_posts, 1000000U);
    antarctica.mosaic.target.crop = Bounds{-70, -82, -50, -75};
    EXPECT_GT(imported(folder, antarctica).info.valid_posts, 10000U);
}

TEST(RealData, ZippedAsciiGridWithAPrjBesideTheArchive) {
    RELEVO_NEEDS_DATA("coast/cairns.zip");
    const SceneFolder folder;
    const auto scene = imported(folder, options_for(shared_data("coast/cairns.zip")));
    EXPECT_EQ(scene.info.sources.at(0).crs, "EPSG:32755");
    EXPECT_NEAR(scene.info.height_min_m, -2153, 5);
    EXPECT_NEAR(scene.info.height_max_m, 1599, 5);
    // Bartle Frere, the highest mountain of Queensland: 17.39 S, 145.82 E.
    const auto top =
        std::max_element(scene.heights.samples().begin(), scene.heights.samples().end(),
                         [](float a, float b) { return std::isnan(a) ? !std::isnan(b) : a < b; }) -
        scene.heights.samples().begin();
    const auto place = scene.info.frame.lat_lon({static_cast<double>(top % scene.heights.columns()),
                                                 static_cast<double>(top / scene.heights.columns())});
    EXPECT_NEAR(place.lat.value, -17.39, 0.02);
    EXPECT_NEAR(place.lon.value, 145.82, 0.02);
}

}  // namespace
}  // namespace relevo::ingest
