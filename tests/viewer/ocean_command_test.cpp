#include <array>
#include <filesystem>
#include <string>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/run_program.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/scene_for_pictures.hpp"

namespace relevo::test {
namespace {

/// Pictures of a scene by the program itself.
class OceanCommand : public testing::Test {
  protected:
    void import(const std::string& data, const std::string& flags = "") {
        const auto run =
            relevo("ingest " + shared_data(data).string() + " -o " + scene_ + " --quiet " + flags);
        ASSERT_EQ(run.status, 0) << run.err;
    }

    nlohmann::json render(const std::string& flags) const {
        const auto run =
            relevo("render " + scene_ + " -o " + picture_ + " --size 160x90 --samples 1 --json " + flags);
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out);
    }

    /// The pixel in the middle of the last picture.
    std::array<int, 3> middle() const {
        GDALAllRegister();
        const GDALDatasetUniquePtr file(GDALDataset::Open(picture_.c_str()));
        std::array<int, 3> pixel{};
        for (int band = 0; band < 3; ++band) {
            int value = 0;
            EXPECT_EQ(
                file->GetRasterBand(band + 1)->RasterIO(GF_Read, 80, 45, 1, 1, &value, 1, 1, GDT_Int32, 0, 0),
                CE_None);
            pixel[static_cast<std::size_t>(band)] = value;
        }
        return pixel;
    }

    SceneFolder folder_;
    std::string scene_ = (folder_ / "coast.relevo").string();
    std::string picture_ = (folder_ / "a.png").string();
};

void expect_none(const nlohmann::json& json) {
    EXPECT_TRUE(json["ocean"].is_null());
    EXPECT_EQ(json["ocean_vertices"], 0);
    EXPECT_EQ(json["ocean_triangles"], 0);
    EXPECT_EQ(json["ocean_draw_calls"], 0);
    EXPECT_EQ(json["ocean_ms"], 0);
}

TEST_F(OceanCommand, ASceneWithoutSeaHasNoOceanWork) {
    write_mountains(scene_);
    expect_none(render("--ocean geoclipmap --wind 20,0"));
    expect_none(render(""));
}

TEST_F(OceanCommand, EachMeshDrawsACoastAndNothingWhereNoneIsInView) {
    RELEVO_NEEDS_DATA("coast/N43E007.hgt.zip");
    import("coast/N43E007.hgt.zip");
    const std::string sea = " --eye 43.6,7.35,40 --heading 90 --pitch -5";
    for (const std::string mesh : {"geoclipmap", "radial", "projected"}) {
        const auto json = render("--ocean " + mesh + sea);
        EXPECT_EQ(json["ocean"], mesh);
        EXPECT_GT(json["ocean_triangles"], 500) << mesh;
        EXPECT_GT(json["ocean_vertices"], 250) << mesh;
        EXPECT_GE(json["ocean_draw_calls"], 1) << mesh;
        EXPECT_GT(json["ocean_ms"], 0) << mesh;
        expect_none(render("--ocean " + mesh + " --eye 43.6,7.35,40 --pitch 80"));
    }
    EXPECT_NE(render(sea)["ocean"], nullptr);
    expect_none(render("--ocean off" + sea));
    expect_none(render("--layer slope" + sea));
    // Far inland, all around is land that no sea is behind.
    const auto flat = render("--ocean geoclipmap --wind 0" + sea);
    EXPECT_LT(flat["ocean_triangles"], 2000);
}

TEST_F(OceanCommand, APolderIsLandAndTheSeaBesideItWater) {
    RELEVO_NEEDS_DATA("coast/netherlands_30s.nc");
    import("coast/netherlands_30s.nc", "--crs EPSG:4326");
    for (const std::string mesh : {"geoclipmap", "radial", "projected"}) {
        render("--ocean " + mesh +
               " --eye 52.30,4.68,3000 --pitch -90");  // Haarlemmermeer, 4 m below the sea
        const auto polder = middle();
        EXPECT_GT(polder[1], polder[2] + 15) << mesh;
        render("--ocean " + mesh + " --eye 52.45,4.10,3000 --pitch -90");
        const auto sea = middle();
        EXPECT_GT(sea[2], sea[0] + 15) << mesh;
        EXPECT_LT(sea[1], 130) << mesh;
    }
}

TEST_F(OceanCommand, IslandsAndShallowWaterOfARealSeaFloorAreSeen) {
    RELEVO_NEEDS_DATA("coast/france_italy_etopo2.nc");
    import("coast/france_italy_etopo2.nc", "--crs EPSG:4326 --sea depths");
    render("--eye 42.15,9.1,30000 --pitch -90");  // Corsica
    const auto island = middle();
    EXPECT_GT(island[1], island[2]);
    render("--eye 41.0,6.0,30000 --pitch -90");
    const auto deep = middle();
    EXPECT_GT(deep[2], deep[0] + 10);
}

TEST_F(OceanCommand, WrongFlagsAreRefused) {
    write_mountains(scene_);
    for (const std::string flags :
         {"--ocean waves", "--wind -1", "--wind 41,0", "--wind 1,2,3", "--wind x", "--time 1e12"}) {
        const auto run = relevo("render " + scene_ + " -o " + picture_ + " " + flags);
        EXPECT_EQ(run.status, 2) << flags;
        EXPECT_FALSE(std::filesystem::exists(picture_));
    }
}

TEST_F(OceanCommand, TheWholeViewInOneStringHasTheSea) {
    RELEVO_NEEDS_DATA("coast/N43E007.hgt.zip");
    import("coast/N43E007.hgt.zip");
    const auto json =
        render("--ocean radial --wind 9.5,33 --time 12.25 --eye 43.6,7.35,40 --heading 90 --pitch -5");
    const auto first = middle();
    const auto again = render("--at " + json["at"].get<std::string>());
    EXPECT_EQ(again["at"], json["at"]);
    EXPECT_EQ(again["ocean_triangles"], json["ocean_triangles"]);
    EXPECT_EQ(middle(), first);
}

}  // namespace
}  // namespace relevo::test
