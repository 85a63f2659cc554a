// `relevo measure` as people and scripts use it: the contract of its JSON, its exit statuses, and its figures
// against gdallocationinfo and GeodSolve.

#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geo/geodesic.hpp"
#include "lod/measure/point.hpp"
#include "tests/app/run_program.hpp"
#include "tests/geo/outside_program.hpp"
#include "tests/lod/measured_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::test {
namespace {

std::vector<std::string> keys_of(const nlohmann::json& json) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    return keys;
}

nlohmann::json measure(const std::filesystem::path& scene, const std::string& arguments) {
    const auto run = relevo(fmt::format("measure '{}' {} --json", scene.string(), arguments));
    EXPECT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << run.out;
    return json;
}

/// A scene of UTM data, in text: what measure reads is the scene alone.
class Measure : public testing::Test {
  protected:
    void SetUp() override {
        SceneParts parts = made_up_scene(40, 30);
        parts.info.sources[0].crs = "EPSG:32613";
        parts.info.sources[0].crs_wkt = "EPSG:32613";
        parts.info.sources[0].step_unit = "metre";
        parts.info.resampling.rms_m = 0.25;
        parts.info.resampling_method = "cubic";
        frame = parts.info.frame;
        heights = parts.heights;
        const auto written = write_scene(parts, scene());
        ASSERT_TRUE(written) << written.error().message;
    }
    std::filesystem::path scene() const { return folder / "a.relevo"; }

    SceneFolder folder;
    geo::GridFrame frame;
    lod::Raster<float> heights;
};

std::string text(geo::LatLon place) {
    return fmt::format("{:.15f},{:.15f}", place.lat.value, place.lon.value);
}

TEST_F(Measure, PointHasTheContractsKeys) {
    const auto place = frame.lat_lon({7, 12});
    const auto json = measure(scene(), "point " + text(place));
    EXPECT_EQ(keys_of(json), (std::vector<std::string>{"H_m",
                                                       "N_m",
                                                       "aspect_deg",
                                                       "class",
                                                       "dms",
                                                       "filled",
                                                       "h_m",
                                                       "height_accuracy_m",
                                                       "lat",
                                                       "lon",
                                                       "mgrs",
                                                       "modelled",
                                                       "native_sample",
                                                       "position_accuracy_m",
                                                       "resampling_rms_m",
                                                       "resolution_m",
                                                       "slope_deg",
                                                       "source_crs",
                                                       "utm",
                                                       "vertical_datum"}));
    EXPECT_EQ(json["H_m"].get<double>(), static_cast<double>(heights.at(7, 12)));
    EXPECT_EQ(json["h_m"].get<double>(), json["H_m"].get<double>() + json["N_m"].get<double>());
    EXPECT_NEAR(json["N_m"].get<double>(), -15, 5.001);  // of the scene's own geoid
    EXPECT_EQ(json["class"], "land");
    EXPECT_EQ(json["vertical_datum"], "EGM96");
    EXPECT_EQ(json["resampling_rms_m"], 0.25);
    EXPECT_NEAR(json["resolution_m"].get<double>(), 92.5, 0.1);
    EXPECT_EQ(json["filled"], false);
    EXPECT_EQ(json["modelled"], false);
    EXPECT_EQ(json["source_crs"]["code"], "EPSG:32613");
    // The source's own CRS here is the zone's UTM.
    const auto utm = fmt::format("13N {:.2f} {:.2f}", json["source_crs"]["x"].get<double>(),
                                 json["source_crs"]["y"].get<double>());
    EXPECT_EQ(json["utm"], utm);
}

TEST_F(Measure, VoidsAndOutsideHaveNoHeight) {
    const auto hole = measure(scene(), "point " + text(frame.lat_lon({7, 1})));
    EXPECT_EQ(hole["class"], "void");
    EXPECT_TRUE(hole["H_m"].is_null() && hole["h_m"].is_null());
    const auto outside = measure(scene(), "point -33.5,151.2");  // a latitude is no option
    EXPECT_EQ(outside["class"], "outside");
    EXPECT_TRUE(outside["H_m"].is_null() && outside["resolution_m"].is_null());
    EXPECT_EQ(outside["lat"], -33.5);
}

TEST_F(Measure, EveryFormatIsTheSamePlace) {
    // 37.08 N 105.31 W, to a metre at least.
    const auto expected = measure(scene(), "point 37.08,-105.31");
    ASSERT_EQ(expected["class"], "land");
    for (const std::string place : {"\"37.08N 105.31W\"", "\"37d4'48\\\"N 105d18'36\\\"W\"",
                                    "\"37 4 48 -105 18 36\"", "'37°04′48″N, 105°18′36″W'"}) {
        const auto json = measure(scene(), "point " + place);
        EXPECT_NEAR(json["H_m"].get<double>(), expected["H_m"].get<double>(), 1e-6) << place;
    }
    for (const std::string& place :
         {expected["utm"].get<std::string>(), expected["mgrs"].get<std::string>()}) {
        const auto json = measure(scene(), "point '" + place + "'");
        EXPECT_NEAR(json["lat"].get<double>(), 37.08, 1e-5) << place;
        EXPECT_NEAR(json["lon"].get<double>(), -105.31, 1e-5) << place;
    }
}

TEST_F(Measure, LineHasTheContractsKeysAndGeodSolvesFigures) {
    const auto from = frame.lat_lon({3, 12});
    const auto to = frame.lat_lon({30, 20});
    const auto json = measure(scene(), "line " + text(from) + " " + text(to));
    EXPECT_EQ(keys_of(json), (std::vector<std::string>{"azimuth1_deg", "azimuth2_deg", "climb_m", "descent_m",
                                                       "geodesic_m", "surface_m"}));
    EXPECT_GT(json["surface_m"].get<double>(), json["geodesic_m"].get<double>());
    EXPECT_NEAR(json["climb_m"].get<double>() - json["descent_m"].get<double>(),
                static_cast<double>(heights.at(30, 20) - heights.at(3, 12)), 1e-3);
    const auto answer =
        ask("GeodSolve -i -p 10", {fmt::format("{:.15f} {:.15f} {:.15f} {:.15f}", from.lat.value,
                                               from.lon.value, to.lat.value, to.lon.value)});
    if (answer.size() == 1) {
        EXPECT_NEAR(json["geodesic_m"].get<double>(), numbers(answer[0])[2], 1e-8);
        EXPECT_NEAR(json["azimuth1_deg"].get<double>(), numbers(answer[0])[0], 1e-9);
    }
    const auto across = measure(scene(), "line " + text(from) + " 10,10");
    EXPECT_TRUE(across["surface_m"].is_null() && across["climb_m"].is_null() &&
                across["descent_m"].is_null());
    EXPECT_GT(across["geodesic_m"].get<double>(), 9e6);
}

TEST_F(Measure, TextNamesTheDatumOfEveryHeight) {
    const auto run = relevo("measure '" + scene().string() + "' point " + text(frame.lat_lon({7, 12})));
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("m above EGM96 (assumed"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("m above the WGS 84 ellipsoid"), std::string::npos) << run.out;
}

TEST_F(Measure, EveryKindOfMeasurementIsOneJsonObject) {
    const auto at = [&](double column, double row) { return text(frame.lat_lon({column, row})); };
    const auto path = measure(scene(), "path " + at(3, 12) + " " + at(20, 14) + " " + at(30, 20));
    EXPECT_EQ(path["legs"].size(), 2u);
    EXPECT_EQ(path["turns_deg"].size(), 1u);
    EXPECT_GT(path["surface_m"].get<double>(), path["length_m"].get<double>());
    const auto profile = measure(scene(), "profile " + at(3, 12) + " " + at(20, 14) + " " + at(30, 20));
    EXPECT_NEAR(profile["length_m"].get<double>(), path["length_m"].get<double>(), 1e-9);
    EXPECT_GT(profile["samples"].size(), 30u);
    EXPECT_NEAR(profile["mean_slope"].get<double>() * profile["length_m"].get<double>(),
                path["climb_m"].get<double>() + path["descent_m"].get<double>(), 1e-6);
    const auto area =
        measure(scene(), "area " + at(3, 12) + " " + at(30, 14) + " " + at(12, 25) + " --plane 5");
    EXPECT_EQ(area["plane_H_m"], 5);
    const auto level =
        measure(scene(), "area " + at(3, 12) + " " + at(30, 14) + " " + at(12, 25) + " --plane mean");
    EXPECT_EQ(level["plane_H_m"], level["mean_H_m"]);
    EXPECT_EQ(relevo("measure '" + scene().string() + "' area " + at(3, 12) + " " + at(30, 14) + " " +
                     at(12, 25) + " --plane least")
                  .status,
              2);
    EXPECT_NEAR(area["measured_area_m2"].get<double>() / area["geodesic_area_m2"].get<double>(), 1, 1e-6);
    const auto sight = measure(scene(), "sight " + at(3, 12) + " " + at(30, 14) + " --eye-height 5000");
    EXPECT_EQ(sight["visible"], true);
    EXPECT_EQ(sight["refraction"], 0.13);
    const auto tif = (folder / "seen.tif").string();
    const auto shed =
        measure(scene(), "viewshed " + at(20, 15) + " --radius 1000 --eye-height 1000 -o '" + tif + "'");
    EXPECT_GT(shed["visible_posts"].get<int>(), 100);
    EXPECT_EQ(
        relevo("measure '" + scene().string() + "' viewshed " + at(20, 15) + " --radius 9 -o '" + tif + "'")
            .status,
        2);  // it is there
    const auto info = ask("gdalinfo '" + tif + "'", {});
    if (info.empty()) return;  // gdal-bin is not installed
    std::string all;
    for (const std::string& line : info) all += line;
    EXPECT_NE(all.find("NoData Value=255"), std::string::npos);
    EXPECT_NE(all.find("AREA_OR_POINT=Point"), std::string::npos);
    EXPECT_NE(all.find("4326"), std::string::npos);
}

TEST_F(Measure, FilesAreMeasuredToTheLastDigit) {
    const auto at = [&](double column, double row) { return text(frame.lat_lon({column, row})); };
    const std::string places = at(3, 12) + " " + at(30, 14) + " " + at(12, 25);
    const auto area = measure(scene(), "area " + places);
    for (const char* name : {"a.geojson", "a.csv", "a.kml"}) {
        const auto file = "'" + (folder / name).string() + "'";
        EXPECT_EQ(measure(scene(), "area " + places + " --name Tri --save " + file), area);
        auto again = measure(scene(), "area --from " + file)["measurements"];
        ASSERT_EQ(again.size(), 1u);
        EXPECT_EQ(again[0]["name"], "Tri");
        again[0].erase("name");
        EXPECT_EQ(again[0], area);
        EXPECT_EQ(relevo("measure '" + scene().string() + "' point --from " + file).status, 3);
        EXPECT_EQ(relevo("measure '" + scene().string() + "' area " + places + " --save " + file).status, 2);
    }
    const auto imperial = relevo("measure '" + scene().string() + "' area " + places + " --units imperial");
    EXPECT_NE(imperial.out.find(" acres on"), std::string::npos) << imperial.out;
    EXPECT_NE(imperial.out.find(" ft at"), std::string::npos) << imperial.out;
    EXPECT_EQ(relevo("measure '" + scene().string() + "' area " + at(3, 3) + " " + at(9, 9) + " " + at(9, 3) +
                     " " + at(3, 9))
                  .status,
              3);
}

TEST_F(Measure, ExitStatuses) {
    const auto status = [&](const std::string& arguments) { return relevo("measure " + arguments).status; };
    const std::string here = "'" + scene().string() + "' ";
    EXPECT_EQ(status(here + "point 95,0"), 2);
    EXPECT_EQ(status(here + "point nan,0"), 2);
    EXPECT_EQ(status(here + "point 37,58,-105,49"), 2);
    EXPECT_EQ(status(here + "point"), 2);
    EXPECT_EQ(status(here + "point 1,2 3,4"), 2);
    EXPECT_EQ(status(here + "line 1,2"), 2);
    EXPECT_EQ(status(here + "walk 1,2"), 2);
    EXPECT_EQ(status("'" + (folder / "nothing.relevo").string() + "' point 1,2"), 3);

    // A flipped bit in the heights is damage, and never a height.
    const auto opened = lod::Scene::open(scene());
    ASSERT_TRUE(opened);
    const auto file = scene() / opened->info().heights.front().file;
    std::string bytes = contents(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::filesystem::permissions(file, std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
    replace(file, bytes);
    const auto damaged = relevo("measure " + here + "point " + text(frame.lat_lon({7, 12})) + " --json");
    EXPECT_EQ(damaged.status, 4);
    EXPECT_TRUE(damaged.out.empty());
    EXPECT_NE(damaged.err.find("a.relevo"), std::string::npos) << damaged.err;
}

// --- Real data

class RealPosts : public testing::TestWithParam<const char*> {};

TEST_P(RealPosts, AreGdallocationinfosExactly) {
    RELEVO_NEEDS_DATA(GetParam());
    const auto source = shared_data(GetParam());
    const SceneFolder folder;
    const auto path = folder / "a.relevo";
    const auto run = relevo(fmt::format("ingest '{}' -o '{}' --quiet", source.string(), path.string()));
    ASSERT_EQ(run.status, 0) << run.err;
    const auto scene = lod::Scene::open(path);
    ASSERT_TRUE(scene) << scene.error().message;
    const geo::GridFrame& frame = scene->info().frame;

    std::mt19937 random(1000);
    std::vector<std::pair<int, int>> posts;
    std::vector<std::string> input;
    for (int i = 0; i < 3000; ++i) {
        posts.emplace_back(static_cast<int>(random() % static_cast<unsigned>(frame.columns)),
                           static_cast<int>(random() % static_cast<unsigned>(frame.rows)));
        input.push_back(fmt::format("{} {}", posts.back().first, posts.back().second));
    }
    const auto answers = ask("gdallocationinfo -valonly '" + source.string() + "'", input);
    if (answers.size() != posts.size())
        GTEST_SKIP() << "gdallocationinfo is not installed (package gdal-bin)";

    lod::HeightSampler sampler(*scene);
    int valid = 0;
    for (std::size_t i = 0; i < posts.size() && valid < 1000; ++i) {
        const auto place =
            frame.lat_lon({static_cast<double>(posts[i].first), static_cast<double>(posts[i].second)});
        const auto point = lod::measure_point(sampler, place);
        ASSERT_TRUE(point) << point.error().message;
        if (!point->H) continue;  // voids are another test's
        EXPECT_EQ(point->H->m, numbers(answers[i])[0]) << input[i];
        if (valid++ < 10) {  // the program is the same code: a few suffice
            EXPECT_EQ(measure(path, "point " + text(place))["H_m"].get<double>(), numbers(answers[i])[0]);
        }
    }
    EXPECT_EQ(valid, 1000);
}

INSTANTIATE_TEST_SUITE_P(Sources, RealPosts,
                         testing::Values("mountains/mt_rainier_90m.tif", "mountains/baltoro.tif",
                                         "mosaic/gabon/N00E010.hgt", "coast/N43E007.hgt.zip"));

}  // namespace
}  // namespace relevo::test
