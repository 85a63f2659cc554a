// --ground-map as people use it: a file, a picture, and what is on it.

#include <array>
#include <vector>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "tests/app/run_program.hpp"
#include "tests/viewer/scene_for_pictures.hpp"

namespace relevo::test {
namespace {

class GroundMapCommand : public testing::Test {
  protected:
    GroundMapCommand()
        : scene_((folder_ / "mountains.relevo").string()), map_((folder_ / "cover.tif").string()) {
        GDALAllRegister();
        write_mountains(scene_);
    }

    /// All of the scene is of one material.
    void write_map(int bands, int material) const {
        const auto extent = lod::Scene::open(scene_)->info().frame.extent();
        auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        const GDALDatasetUniquePtr made(driver->Create(map_.c_str(), 8, 8, bands, GDT_Byte, nullptr));
        std::array<double, 6> place{extent.west - 1,
                                    (extent.east - extent.west + 2) / 8,
                                    0,
                                    extent.north + 1,
                                    0,
                                    -(extent.north - extent.south + 2) / 8};
        made->SetGeoTransform(place.data());
        OGRSpatialReference crs;
        crs.importFromEPSG(4326);
        made->SetSpatialRef(&crs);
        for (int band = 0; band < bands; ++band)
            made->GetRasterBand(band + 1)->Fill(band == material ? 255 : 0);
    }

    auto render(const std::string& flags) const {
        return relevo("render " + scene_ + " -o " + (folder_ / "a.png").string() +
                      " --size 160x90 --layer terrain --sun 0,80 " + flags);
    }

    /// Of the middle of the picture.
    std::array<double, 3> colour() const {
        const GDALDatasetUniquePtr file(GDALDataset::Open((folder_ / "a.png").c_str()));
        std::array<double, 3> mean{};
        for (int band = 0; band < 3; ++band) {
            std::vector<int> pixels(40 * 20);
            EXPECT_EQ(file->GetRasterBand(band + 1)->RasterIO(GF_Read, 60, 40, 40, 20, pixels.data(), 40, 20,
                                                              GDT_Int32, 0, 0, nullptr),
                      CE_None);
            for (const int value : pixels) mean[static_cast<std::size_t>(band)] += value / 800.0;
        }
        return mean;
    }

    SceneFolder folder_;
    std::string scene_, map_;
};

TEST_F(GroundMapCommand, PaintsTheGround) {
    for (const char* lod : {"--lod soar", "--lod lstr"}) {
        ASSERT_EQ(render(lod).status, 0);
        const auto without = colour();
        write_map(4, 3);
        const auto run = render(std::string(lod) + " --ground-map " + map_);
        ASSERT_EQ(run.status, 0) << run.err;
        const auto snow = colour();
        EXPECT_GT(snow[2], snow[0]) << lod;  // bluish white
        EXPECT_GT(snow[1], 150) << lod;
        EXPECT_GT(snow[1], without[1] + 40) << lod;
        write_map(4, 0);
        ASSERT_EQ(render(std::string(lod) + " --ground-map " + map_).status, 0);
        const auto grass = colour();
        EXPECT_GT(grass[1], grass[2] + 20) << lod;
        EXPECT_LT(grass[1], snow[1] - 40) << lod;
    }
}

TEST_F(GroundMapCommand, SaysWhatIsWrongWithAFile) {
    write_map(3, 0);
    const auto three = render("--ground-map " + map_);
    EXPECT_EQ(three.status, 3);
    EXPECT_NE(three.err.find("--ground-map: cover.tif: it has 3 bands"), std::string::npos) << three.err;
    EXPECT_EQ(render("--ground-map /no/such.tif").status, 3);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
}

}  // namespace
}  // namespace relevo::test
