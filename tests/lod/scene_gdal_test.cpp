// What GDAL's own programs see of a scene: the posts, where they belong.

#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/geo/outside_program.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;

nlohmann::json gdalinfo(const fs::path& file) {
    std::string text;
    for (const std::string& line : ask(fmt::format("gdalinfo -json '{}'", file.string()), {}))
        text += line + "\n";
    return nlohmann::json::parse(text, nullptr, false);
}

class SceneInGdal : public testing::TestWithParam<lod::HeightType> {
  protected:
    void SetUp() override {
        parts_ = made_up_scene(700, 600, GetParam());
        for (int row = 512; row < 600; ++row) {  // a block of voids, which is not stored
            for (int column = 0; column < 512; ++column) {
                float& height = parts_.heights.at(column, row);
                if (!std::isnan(height)) ++parts_.info.void_posts, --parts_.info.valid_posts;
                height = std::numeric_limits<float>::quiet_NaN();
            }
        }
        ASSERT_TRUE(write_scene(parts_, folder_ / "first.relevo"));
        fs::rename(folder_ / "first.relevo", folder_ / "moved.relevo");  // paths must be relative
        info_ = gdalinfo(mosaic_);
        if (info_.is_discarded()) GTEST_SKIP() << "gdalinfo is not installed";
    }

    SceneFolder folder_;
    fs::path mosaic_ = folder_ / "moved.relevo/heights.vrt";
    SceneParts parts_;
    nlohmann::json info_;
};

TEST_P(SceneInGdal, HasTheGeoreference) {
    const geo::GridFrame& frame = parts_.info.frame;
    EXPECT_EQ(info_["size"], nlohmann::json({700, 600}));
    EXPECT_EQ(info_["metadata"][""]["AREA_OR_POINT"], "Point");
    EXPECT_EQ(info_["stac"]["proj:epsg"], 4326);
    const auto transform = info_["geoTransform"].get<std::vector<double>>();
    EXPECT_NEAR(transform[0] + transform[1] / 2, frame.west, 1e-13);
    EXPECT_NEAR(transform[3] + transform[5] / 2, frame.north, 1e-13);
    EXPECT_NEAR(transform[1], frame.step_x, 1e-15);  // gdalinfo prints 15 digits
    EXPECT_NEAR(transform[5], -frame.step_y, 1e-15);

    const auto block = gdalinfo(folder_ / "moved.relevo/heights/r0001-c0001.tif");
    EXPECT_EQ(block["metadata"][""]["AREA_OR_POINT"], "Point");
    EXPECT_EQ(block["stac"]["proj:epsg"], 4326);
    const auto corner = block["geoTransform"].get<std::vector<double>>();
    EXPECT_NEAR(corner[0] + corner[1] / 2, frame.west + 512 * frame.step_x, 1e-12);
    EXPECT_NEAR(corner[3] + corner[5] / 2, frame.north - 512 * frame.step_y, 1e-12);
}

TEST_P(SceneInGdal, HasTheHeightsAtTheirLatitudeAndLongitude) {
    std::mt19937 random(3);
    std::vector<std::string> places;
    std::vector<float> heights;
    for (int i = 0; i < 1000; ++i) {
        const int column = std::uniform_int_distribution<int>(0, 699)(random);
        const int row = i < 50 ? 1 : std::uniform_int_distribution<int>(0, 599)(random);
        const geo::GridFrame& frame = parts_.info.frame;
        places.push_back(
            fmt::format("{} {}", frame.west + column * frame.step_x, frame.north - row * frame.step_y));
        heights.push_back(parts_.heights.at(column, row));
    }
    const auto answers = ask(fmt::format("gdallocationinfo -valonly -geoloc '{}'", mosaic_.string()), places);
    ASSERT_EQ(answers.size(), 1000U);
    const bool whole = GetParam() == lod::HeightType::int16;
    for (std::size_t i = 0; i < 1000; ++i) {
        if (std::isnan(heights[i])) {
            EXPECT_EQ(answers[i], whole ? "-32768" : "nan") << places[i];
        } else {
            EXPECT_EQ(std::stof(answers[i]), heights[i]) << places[i];
        }
    }
}

TEST_P(SceneInGdal, KeepsItsFilesWhenItIsLookedAt) {
    // It writes statistics into the VRT, in its own form; that is not damage.
    ask(fmt::format("gdalinfo -stats '{}'", mosaic_.string()), {});
    const auto scene = lod::Scene::open(folder_ / "moved.relevo");
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->verify().empty());
    EXPECT_TRUE(write_scene(parts_, folder_ / "moved.relevo", true));
}

INSTANTIATE_TEST_SUITE_P(Types, SceneInGdal,
                         testing::Values(lod::HeightType::int16, lod::HeightType::float32),
                         [](const auto& type) { return std::string(to_string(type.param)); });

}  // namespace
}  // namespace relevo::test
