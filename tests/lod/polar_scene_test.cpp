// Scenes around the poles on disk: what scene.json says, and where GDAL and PROJ find their heights.

#include <array>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lod/scene/scene_files.hpp"
#include "tests/geo/outside_program.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

/// The pole lies inside, between posts.
SceneParts polar_scene(geo::FrameKind kind) {
    SceneParts parts = made_up_scene(700, 600);
    parts.info.frame = {kind, 2e6 - 40000.5, 2e6 + 33000.25, 100, 125.5, 700, 600};
    return parts;
}

class PolarScene : public testing::TestWithParam<geo::FrameKind> {};

TEST_P(PolarScene, KeepsItsFrame) {
    const SceneFolder folder;
    const SceneParts parts = polar_scene(GetParam());
    ASSERT_TRUE(write_scene(parts, folder / "a.relevo"));
    const auto scene = lod::Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene) << scene.error().message;
    const geo::GridFrame& frame = scene->info().frame;
    EXPECT_EQ(frame.kind, GetParam());
    EXPECT_EQ(frame.west, 2e6 - 40000.5);
    EXPECT_EQ(frame.north, 2e6 + 33000.25);
    EXPECT_EQ(frame.step_x, 100);
    EXPECT_EQ(frame.step_y, 125.5);

    const auto json = nlohmann::json::parse(contents(folder / "a.relevo/scene.json"));
    EXPECT_EQ(json["frame"]["kind"], GetParam() == geo::FrameKind::ups_north ? "ups_north" : "ups_south");
    EXPECT_EQ(json["frame"]["step_unit"], "metre");
    const std::pair<const char*, const char*> edits[] = {{"/frame/kind", "\"geographic\""},
                                                         {"/frame/kind", "\"ups\""},
                                                         {"/frame/step_unit", "\"degree\""},
                                                         {"/frame/west", "1e300"},
                                                         {"/frame/west", "null"},
                                                         {"/frame/north", "-1e9"},
                                                         {"/frame/step_x", "0"},
                                                         {"/frame/step_x", "-100"},
                                                         {"/frame/step_x", "1e6"},
                                                         {"/frame/step_y", "1e5"},
                                                         {"/frame/columns", "0"},
                                                         {"/frame/rows", "1e3"}};
    for (const auto& [where, value] : edits) {
        auto edited = json;
        edited[nlohmann::json::json_pointer(where)] = nlohmann::json::parse(value);
        EXPECT_FALSE(lod::scene_info_from_json(edited)) << where << " = " << value;
    }
}

TEST_P(PolarScene, LiesInGdalWhereItLies) {
    const SceneFolder folder;
    const SceneParts parts = polar_scene(GetParam());
    ASSERT_TRUE(write_scene(parts, folder / "a.relevo"));
    const std::string mosaic = (folder / "a.relevo/heights.vrt").string();
    for (const std::string& file : {mosaic, (folder / "a.relevo/heights/r0001-c0001.tif").string()}) {
        std::string text;
        for (const std::string& line : ask(fmt::format("gdalinfo -json '{}'", file), {})) text += line;
        const auto info = nlohmann::json::parse(text, nullptr, false);
        if (info.is_discarded()) GTEST_SKIP() << "gdalinfo is not installed";
        EXPECT_EQ(info["stac"]["proj:epsg"], GetParam() == geo::FrameKind::ups_north ? 5041 : 5042);
        EXPECT_EQ(info["metadata"][""]["AREA_OR_POINT"], "Point");
    }

    // A place a quarter step from a post is found at that post, by way of PROJ.
    std::vector<std::string> places;
    std::vector<float> heights;
    for (int i = 0; i < 500; ++i) {
        const int column = (i * 271) % 700;
        const int row = (i * 131) % 600;
        for (const double off : {-0.25, 0.25}) {
            const auto place = parts.info.frame.lat_lon({column + off, row - off});
            places.push_back(fmt::format("{:.13f} {:.13f}", place.lon.value, place.lat.value));
            heights.push_back(parts.heights.at(column, row));
        }
    }
    const auto answers = ask(fmt::format("gdallocationinfo -valonly -wgs84 '{}'", mosaic), places);
    ASSERT_EQ(answers.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (std::isnan(heights[i])) {
            EXPECT_EQ(answers[i], "nan") << places[i];
        } else {
            EXPECT_EQ(std::stof(answers[i]), heights[i]) << places[i];
        }
    }
}

TEST_P(PolarScene, IsWhereProjHasIt) {
    const SceneParts parts = polar_scene(GetParam());
    std::vector<std::string> places;
    std::vector<geo::GridPosition> posts;
    for (int i = 0; i < 200; ++i) {
        const geo::GridPosition at{(i * 271) % 700 + 0.5, static_cast<double>((i * 131) % 600)};
        const auto place = parts.info.frame.lat_lon(at);
        places.push_back(fmt::format("{:.14f} {:.14f}", place.lat.value, place.lon.value));
        posts.push_back(at);
    }
    const auto answers = ask(fmt::format("cs2cs -f '%.6f' EPSG:4326 {}",
                                         GetParam() == geo::FrameKind::ups_north ? "EPSG:5041" : "EPSG:5042"),
                             places);
    if (answers.size() != places.size()) GTEST_SKIP() << "cs2cs is not installed";
    for (std::size_t i = 0; i < places.size(); ++i) {
        double easting = 0;
        double northing = 0;
        std::istringstream(answers[i]) >> easting >> northing;
        EXPECT_NEAR(easting, parts.info.frame.west + 100 * posts[i].column, 2e-6);
        EXPECT_NEAR(northing, parts.info.frame.north - 125.5 * posts[i].row, 2e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(Poles, PolarScene,
                         testing::Values(geo::FrameKind::ups_north, geo::FrameKind::ups_south),
                         [](const auto& kind) { return std::string(lod::to_string(kind.param)); });

}  // namespace
}  // namespace relevo::test
