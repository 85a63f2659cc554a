// Many sources as one grid: real tiles that adjoin, and made ones of which every post is known.
#include <chrono>
#include <cmath>
#include <fstream>
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

}  // namespace
}  // namespace relevo::ingest
