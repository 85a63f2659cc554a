// The example as somebody runs it: from a GeoTIFF to pictures, and what is on them.

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::test {
namespace {

/// A round hill on a plain, 257 posts of 100 m a side.
void write_hill(const std::filesystem::path& file) {
    GDALAllRegister();
    constexpr int kSide = 257;
    auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const GDALDatasetUniquePtr made(driver->Create(file.c_str(), kSide, kSide, 1, GDT_Float32, nullptr));
    ASSERT_TRUE(made);
    std::array<double, 6> place{9.0, 0.001, 0, 47.0, 0, -0.001};
    made->SetGeoTransform(place.data());
    OGRSpatialReference crs;
    crs.importFromEPSG(4326);
    made->SetSpatialRef(&crs);
    std::vector<float> row(kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double away = std::hypot(x - 128, y - 128) / 50;
            row[static_cast<std::size_t>(x)] = static_cast<float>(400 + 900 * std::exp(-away * away));
        }
        ASSERT_EQ(made->GetRasterBand(1)->RasterIO(GF_Write, 0, y, kSide, 1, row.data(), kSide, 1,
                                                   GDT_Float32, 0, 0, nullptr),
                  CE_None);
    }
}

int fly_over(const std::filesystem::path& dem, const std::filesystem::path& folder, int pictures) {
    return std::system(fmt::format("'{}' '{}' '{}' {} >'{}' 2>&1", RELEVO_FLY_OVER, dem.string(),
                                   folder.string(), pictures, (folder / "log").string())
                           .c_str());
}

struct Rgb {
    double r = 0, g = 0, b = 0;
    double spread = 0;  ///< mean distance of neighbouring pixels' greens
};

/// Of rows of a picture, parts of its height.
Rgb mean_of(const std::filesystem::path& picture, double from, double to) {
    const GDALDatasetUniquePtr file(GDALDataset::Open(picture.c_str()));
    if (!file || file->GetRasterCount() < 3) throw std::runtime_error("no picture: " + picture.string());
    const int width = file->GetRasterXSize();
    const int first = static_cast<int>(from * file->GetRasterYSize());
    const int rows = static_cast<int>(to * file->GetRasterYSize()) - first;
    std::array<double, 3> sum{};
    Rgb mean;
    for (int band = 0; band < 3; ++band) {
        std::vector<int> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
        if (file->GetRasterBand(band + 1)->RasterIO(GF_Read, 0, first, width, rows, values.data(), width,
                                                    rows, GDT_Int32, 0, 0, nullptr) != CE_None)
            throw std::runtime_error("damaged: " + picture.string());
        for (std::size_t i = 0; i < values.size(); ++i) {
            sum[static_cast<std::size_t>(band)] += values[i];
            if (band == 1 && i > 0) mean.spread += std::abs(values[i] - values[i - 1]);
        }
    }
    const double pixels = static_cast<double>(width) * rows;
    mean.r = sum[0] / pixels;
    mean.g = sum[1] / pixels;
    mean.b = sum[2] / pixels;
    mean.spread /= pixels;
    return mean;
}

TEST(FlyOver, MakesASceneItsNodesAndPicturesOfGroundUnderASky) {
    const SceneFolder folder;
    write_hill(folder / "hill.tif");
    ASSERT_EQ(fly_over(folder / "hill.tif", folder.path(), 3), 0) << contents(folder / "log");
    EXPECT_TRUE(std::filesystem::exists(folder / "dem.relevo/chunks.bin"));
    EXPECT_NE(contents(folder / "log").find("257 x 257 posts"), std::string::npos);
    for (const char* name : {"flight-01.png", "flight-02.png", "flight-03.png"}) {
        const Rgb sky = mean_of(folder / name, 0, 0.05);
        const Rgb ground = mean_of(folder / name, 0.85, 1);
        EXPECT_GT(sky.b, sky.r + 15) << name;
        EXPECT_LT(ground.b, ground.g) << name;  // grass
        EXPECT_GT(ground.g, 30) << name;
        EXPECT_GT(ground.spread, 0.5) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "flight-04.png"));
}

TEST(FlyOver, SaysWhatIsWrong) {
    const SceneFolder folder;
    EXPECT_NE(fly_over(folder / "none.tif", folder.path(), 1), 0);
    EXPECT_NE(contents(folder / "log").find("no such file"), std::string::npos) << contents(folder / "log");
    EXPECT_NE(fly_over(folder / "none.tif", folder.path(), 0), 0);
}

}  // namespace
}  // namespace relevo::test
