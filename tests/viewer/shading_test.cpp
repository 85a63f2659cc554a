// Hillshade against `gdaldem hillshade`, run within GDAL, of the same posts: in pictures from straight above.

#include "viewer/shading.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>

#include "tests/shared_data.hpp"
#include "tests/viewer/read_dem.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::Layer;
using viewer::Shading;

/// Grey values 1 to 255 by gdaldem; 0 at its border. Posts are as far apart as those in the grid's middle.
lod::Raster<float> gdal_hillshade(const Dem& dem, const char* how, const char* gradient) {
    const int side = dem.frame.columns;
    auto* driver = GetGDALDriverManager()->GetDriverByName("MEM");
    constexpr float kNodata = -32768;
    const GDALDatasetUniquePtr grid(driver->Create("", side, side, 1, GDT_Float32, nullptr));
    const auto spacing = dem.frame.spacing({0.5 * side, 0.5 * side});
    std::array<double, 6> metres{0, spacing.column_m, 0, 0, 0, -spacing.row_m};
    grid->SetGeoTransform(metres.data());
    grid->GetRasterBand(1)->SetNoDataValue(static_cast<double>(kNodata));
    lod::Raster<float> heights = dem.heights;
    for (int row = 0; row < side; ++row)
        std::replace_if(
            heights.row(row), heights.row(row) + side, [](float H) { return std::isnan(H); }, kNodata);
    EXPECT_EQ(grid->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, side, side, heights.row(0), side, side,
                                               GDT_Float32, 0, 0, nullptr),
              CE_None);
    CPLStringList arguments;
    arguments.AddString("-of");
    arguments.AddString("MEM");
    for (const char* more : {how, gradient}) {
        if (more != nullptr) arguments.AddString(more);
    }
    if (gradient != nullptr) arguments.AddString("ZevenbergenThorne");
    auto* options = GDALDEMProcessingOptionsNew(arguments.List(), nullptr);
    const GDALDatasetUniquePtr shaded(GDALDataset::FromHandle(
        GDALDEMProcessing("", GDALDataset::ToHandle(grid.get()), "hillshade", nullptr, options, nullptr)));
    GDALDEMProcessingOptionsFree(options);
    lod::Raster<float> grey(side, side);
    if (!shaded) throw std::runtime_error("gdaldem failed");
    EXPECT_EQ(shaded->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, side, side, grey.row(0), side, side,
                                                 GDT_Float32, 0, 0, nullptr),
              CE_None);
    return grey;
}

struct Differences {
    std::vector<double> grey;
    double mean() const {
        return std::accumulate(grey.begin(), grey.end(), 0.0) / static_cast<double>(grey.size());
    }
    double part(double p) {
        std::sort(grey.begin(), grey.end());
        return grey[static_cast<std::size_t>(p * static_cast<double>(grey.size() - 1))];
    }
};

struct Trial {
    const char* file;
    int column, row;
    Shading shading;
    const char* gdal;
};

class ShadingAgainstGdal : public testing::TestWithParam<Trial> {};

TEST_P(ShadingAgainstGdal, IsItsHillshade) {
    const Trial trial = GetParam();
    RELEVO_NEEDS_DATA(trial.file);
    constexpr int kSide = 129;
    const Dem dem = read_dem(shared_data(trial.file), trial.column, trial.row, kSide);
    Studio studio(make_terrain(dem.frame, dem.heights));
    // A tenth of a post a pixel.
    constexpr int kPixels = 900;
    auto camera = above_looking_down(studio.terrain(), kSide / 2, kSide / 2, 0, kPixels, kPixels);
    camera.fov.value = 4;
    const double metres = 0.1 * kPixels * dem.frame.spacing({kSide / 2, kSide / 2}).row_m;
    camera.eye.h.m += metres / (2 * std::tan(camera.fov.radians() / 2));
    viewer::ViewState how;
    how.method = viewer::Method::full;
    const auto picture = studio.draw(
        camera, {.layer = Layer::hillshade, .shading = trial.shading, .background = kMagenta}, how);

    const lod::View view(camera);
    const auto differences = [&](const lod::Raster<float>& truth) {
        Differences found;
        for (int row = 2; row < kSide - 2; ++row) {
            for (int column = 2; column < kSide - 2; ++column) {
                const auto H = static_cast<double>(dem.heights.at(column, row));
                const geo::GridPosition post{static_cast<double>(column), static_cast<double>(row)};
                if (std::isnan(H) || truth.at(column, row) == 0)
                    continue;  // GDAL's where a neighbour is void
                const auto pixel = view.pixel(dem.frame.ecef(post, geo::EllipsoidalHeight{H}) - view.eye());
                const int x = static_cast<int>(pixel.x);
                const int y = static_cast<int>(pixel.y);
                if (pixel.x < 0 || pixel.y < 0 || x >= kPixels || y >= kPixels) continue;
                // Of pixels whose middle is within 0.02 posts of the post: between posts are mixtures.
                if (std::max(std::abs(pixel.x - x - 0.5), std::abs(pixel.y - y - 0.5)) > 0.2) continue;
                // The layer keeps a little light in the shadow: 0.06 + 0.94 lit.
                const double lit = (picture.at(x, y)[0] / 255.0 - 0.06) / 0.94;
                const double expected = (static_cast<double>(truth.at(column, row)) - 1) / 254;
                found.grey.push_back(255 * std::abs(lit - expected));
            }
        }
        return found;
    };
    Differences same = differences(gdal_hillshade(dem, trial.gdal, "-alg"));
    Differences horn = differences(gdal_hillshade(dem, trial.gdal, nullptr));
    ASSERT_GT(same.grey.size(), 1000U);
    fmt::print(
        "[ shading ] {} {}: {} posts, greys of 255 apart: mean {:.2f} p99 {:.2f} max {:.1f}; from Horn's "
        "gradient mean {:.2f} p99 {:.2f}\n",
        trial.file, to_string(trial.shading), same.grey.size(), same.mean(), same.part(0.99), same.part(1),
        horn.mean(), horn.part(0.99));
    // By the same gradient. GDAL's value is rounded and so is the picture's: 0.25 each in the mean, 1 at
    // most. A pixel up to 0.02 posts beside its post adds a fiftieth of the change to the next post, which is
    // up to 200 at a ridge; spacings of columns change by 0.1 % over these rows.
    EXPECT_LT(same.mean(), 1);
    EXPECT_LT(same.part(0.99), 4);
    EXPECT_LT(same.part(1), 8);
}

INSTANTIATE_TEST_SUITE_P(
    Dems, ShadingAgainstGdal,
    testing::Values(
        Trial{"mountains/mt_rainier_90m.tif", 600, 500, Shading::multidirectional, "-multidirectional"},
        Trial{"mountains/mt_everest_90m.tif", 500, 400, Shading::multidirectional, "-multidirectional"},
        Trial{"mountains/mt_everest_90m.tif", 500, 400, Shading::combined, "-combined"},
        Trial{"mountains/mt_rainier_90m.tif", 600, 500, Shading::sun, nullptr}));

/// The grey of a plane that falls towards an azimuth.
int grey_of_plane(double aspect, double steepness, const viewer::DrawSettings& settings) {
    const auto frame = geographic_frame(65, 65, 0.02);  // where columns are as wide as rows
    const double step = frame.spacing({32, 32}).row_m;
    const double a = aspect * 3.14159265358979 / 180;
    Studio studio(make_terrain(frame, make_heights(frame, [&](int column, int row) {
                                   return 5000 -
                                          steepness * step * (column * std::sin(a) - row * std::cos(a));
                               })));
    return studio.draw(above_looking_down(studio.terrain(), 32, 32, 500), settings).at(100, 75)[0];
}

TEST(Shading, OfFourLightsIsTheSumOfTheirs) {
    constexpr double kDegree = 3.14159265358979 / 180;
    for (const auto& [sun, shading] : {std::pair("315,45", Shading::oblique),
                                       {"100,30", Shading::oblique},
                                       {"100,30", Shading::multidirectional}}) {
        const viewer::DrawSettings settings{.layer = Layer::hillshade,
                                            .shading = shading,
                                            .sun = *viewer::parse_sun(sun),
                                            .background = kMagenta};
        const auto direction = settings.sun.direction;
        for (double aspect = 0; aspect < 360; aspect += 24) {
            constexpr double kSteepness = 0.6;
            const double slope = std::atan(kSteepness);
            double sum = 0;
            for (const double turned : {-90.0, -45.0, 0.0, 45.0}) {
                const double apart = (aspect - direction.azimuth.value - turned) * kDegree;
                const double lit =
                    std::sin(direction.elevation.radians()) * std::cos(slope) +
                    std::cos(direction.elevation.radians()) * std::sin(slope) * std::cos(apart);
                const double side = shading == Shading::oblique ? std::sin(apart) : std::cos(apart);
                sum += 0.5 * side * side * std::max(lit, 0.0);
            }
            EXPECT_NEAR(grey_of_plane(aspect, kSteepness, settings), 255 * (0.06 + 0.94 * sum), 2)
                << sun << " aspect " << aspect;
        }
        // Flat ground is as light as under one light.
        EXPECT_NEAR(grey_of_plane(0, 0, settings),
                    255 * (0.06 + 0.94 * std::sin(direction.elevation.radians())), 2);
    }
}

TEST(Shading, IsReadAsItIsWritten) {
    for (const Shading shading :
         {Shading::sun, Shading::multidirectional, Shading::oblique, Shading::combined})
        EXPECT_EQ(*viewer::parse_shading(to_string(shading)), shading);
    EXPECT_EQ(viewer::parse_shading("igor").error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace relevo::test
