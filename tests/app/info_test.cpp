#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/run_program.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

class Info : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(write_scene(parts_, path_)); }

    std::string quoted() const { return fmt::format("'{}'", path_.string()); }

    SceneFolder folder_;
    std::filesystem::path path_ = folder_ / "made up.relevo";
    SceneParts parts_ = made_up_scene(600, 40);
};

TEST_F(Info, ExtentOfAPolarSceneIsInDegrees) {
    // 100 m posts around the south pole, and beside it across the antimeridian (which runs down in UPS
    // South).
    SceneParts parts = made_up_scene(601, 401);
    parts.info.frame = {geo::FrameKind::ups_south, 1970e3, 2020e3, 100, 100, 601, 401};
    for (const bool inside : {true, false}) {
        if (!inside) parts.info.frame.north = 1500e3;
        ASSERT_TRUE(write_scene(parts, path_, true));
        const auto run = relevo("info --json " + quoted());
        ASSERT_EQ(run.status, 0) << run.err;
        const auto json = nlohmann::json::parse(run.out, nullptr, false);
        EXPECT_EQ(json["frame"]["kind"], "ups_south");
        EXPECT_EQ(json["step_unit"], "metre");
        EXPECT_EQ(json["step_x"], 100);
        EXPECT_NEAR(json["step_x_m"], 100 / 0.994, 0.2);
        const auto corner = parts.info.frame.lat_lon({0, 400});
        const auto& extent = json["extent"];
        const auto text = relevo("info " + quoted()).out;
        if (inside) {
            EXPECT_EQ(extent["south"], -90);
            EXPECT_NEAR(extent["north"], -90 + 36.056 / 0.994 / 111.694, 1e-5);  // by the meridian's degree
            EXPECT_EQ(extent["west"], -180);
            EXPECT_EQ(extent["east"], 180);
            EXPECT_NE(text.find("90.0000000 S to 89.675"), std::string::npos) << text;
            EXPECT_NE(text.find("all longitudes"), std::string::npos) << text;
        } else {
            EXPECT_NEAR(extent["north"], corner.lat.value, 1e-12);
            EXPECT_LT(extent["west"], 180);
            EXPECT_GT(extent["east"], 180);
            EXPECT_NEAR(extent["west"].get<double>() + extent["east"].get<double>(), 360, 1e-9);
            EXPECT_NE(text.find(" E to "), std::string::npos) << text;
            EXPECT_NE(text.find(" W\n"), std::string::npos) << text;
        }
        EXPECT_NE(text.find("100 x 100 metre"), std::string::npos) << text;
    }
}

TEST_F(Info, JsonHasTheKeysOfTheContract) {
    const auto run = relevo("info --json " + quoted());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const auto json = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << run.out;
    for (const char* key : {"format_version",
                            "extent",
                            "frame",
                            "n",
                            "columns",
                            "rows",
                            "step_x",
                            "step_y",
                            "step_unit",
                            "vertical_datum",
                            "vertical_assumed",
                            "height_min_m",
                            "height_max_m",
                            "valid_posts",
                            "void_posts",
                            "filled_posts",
                            "sea_posts",
                            "resampling",
                            "sources",
                            "bytes",
                            "bytes_per_post"}) {
        EXPECT_TRUE(json.contains(key)) << key;
    }
    for (const char* key : {"name", "sha256", "crs", "columns", "rows"}) {
        EXPECT_TRUE(json["sources"][0].contains(key)) << key;
    }
    const geo::GridFrame& frame = parts_.info.frame;
    EXPECT_EQ(json["n"], 10);
    EXPECT_EQ(json["columns"], 600);
    EXPECT_EQ(json["extent"]["west"], frame.west);
    EXPECT_EQ(json["extent"]["north"], frame.north);
    EXPECT_NEAR(json["extent"]["east"], frame.west + 599 * frame.step_x, 1e-12);
    EXPECT_NEAR(json["extent"]["south"], frame.north - 39 * frame.step_y, 1e-12);
    EXPECT_EQ(json["vertical_datum"], "EGM96");
    EXPECT_EQ(json["vertical_assumed"], true);
    EXPECT_EQ(json["valid_posts"].get<int>() + json["void_posts"].get<int>(), 600 * 40);
    EXPECT_EQ(json["sea_posts"], 0);
    EXPECT_EQ(json["filled_posts"], 0);

    std::uint64_t bytes = 0;  // of the data files, as the file system counts them
    for (const auto& [name, text] : all_files(path_)) {
        if (name.ends_with(".tif")) bytes += text.size();
    }
    EXPECT_EQ(json["bytes"], bytes);
    EXPECT_NEAR(json["bytes_per_post"], static_cast<double>(bytes) / (600 * 40), 1e-9);
}

TEST_F(Info, TextSaysWhatWasAssumed) {
    const auto run = relevo("info " + quoted());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("EGM96 (assumed"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("made-up.tif"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("37.1000000 N"), std::string::npos) << run.out;
}

TEST_F(Info, IsTheSameInAnyLocale) {
    const auto plain = relevo("info --json " + quoted());
    const auto german = relevo("info --json " + quoted(), "LC_ALL=de_DE.UTF-8");
    EXPECT_EQ(plain.out, german.out);
}

TEST_F(Info, TellsTheMachineAndWhatFitsItWhenAsked) {
    EXPECT_FALSE(nlohmann::json::parse(relevo("info --json " + quoted()).out).contains("machine"));
    const auto run = relevo("info --json --machine " + quoted());
    ASSERT_EQ(run.status, 0) << run.err;
    const auto machine = nlohmann::json::parse(run.out)["machine"];
    EXPECT_GT(machine["memory_bytes"], 0);
    EXPECT_LE(machine["memory_available_bytes"], machine["memory_bytes"]);
    EXPECT_GE(machine["cores"], 1);
    const auto& chosen = machine["chosen"];
    EXPECT_GE(chosen["memory_bytes"], 256 << 20);
    EXPECT_LE(chosen["texel_bytes"], chosen["mesh_bytes"]);
    EXPECT_GE(chosen["swap_factor"], 1.2);
    EXPECT_NE(relevo("info --machine " + quoted()).out.find("\ncaches       --memory "), std::string::npos);
}

TEST_F(Info, MemoryIsASizeOrAuto) {
    if (relevo("render --help").status != 0) GTEST_SKIP();  // built without the viewer
    const auto render = [&](const std::string& memory) {
        return relevo("render /no/such.relevo -o '" + (folder_ / "a.png").string() + "' --memory " + memory);
    };
    for (const char* fine : {"auto", "512MiB", "1000000000"}) EXPECT_EQ(render(fine).status, 3) << fine;
    for (const char* wrong : {"1x", "much", "-1", "''"}) {
        const auto run = render(wrong);
        EXPECT_EQ(run.status, 2) << wrong;
        EXPECT_NE(run.err.find("--memory"), std::string::npos) << run.err;
    }
}

TEST_F(Info, StatusSaysWhoseFaultItIs) {
    EXPECT_EQ(relevo("info").status, 2);
    EXPECT_EQ(relevo("info --nonsense " + quoted()).status, 2);
    EXPECT_EQ(relevo("info '/no/such.relevo'").status, 3);
    const auto none = relevo("info '" + folder_.path().string() + "'");
    EXPECT_EQ(none.status, 3);
    EXPECT_NE(none.err.find("is not a scene"), std::string::npos) << none.err;
    EXPECT_EQ(none.out, "");

    replace(path_ / "scene.json", contents(path_ / "scene.json").substr(0, 200));
    const auto cut = relevo("info --json " + quoted());
    EXPECT_EQ(cut.status, 4);
    EXPECT_NE(cut.err.find("scene.json"), std::string::npos) << cut.err;
    EXPECT_EQ(cut.out, "");
}

}  // namespace
}  // namespace relevo::test
