#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/run_program.hpp"
#include "tests/viewer/window_fixture.hpp"
#include "viewer/flight/flight_path.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;

// Straight down on the middle: up in the picture is north.
constexpr const char* kMap = "--at 35.982222,138.017778,6000/heading=0/pitch=-90/fov=30";

TEST_F(WindowTest, TwoClicksMeasureWhatTheCommandLineMeasures) {
    open(kMap);
    point_at(250, 300);
    press("c");
    const std::string first = said("coordinates ([-0-9.]+, [-0-9.]+), ");
    desktop_.xdotool("click 1");
    point_at(550, 200);
    press("c");
    const std::string second = said("coordinates[^\n]*\ncoordinates ([-0-9.]+, [-0-9.]+), ");
    desktop_.xdotool("click 1");
    const double metres = std::stod(said("distance ([0-9.]+) m"));
    const auto bare = [](std::string place) { return place.erase(place.find(' '), 1); };
    const auto measured =
        relevo(fmt::format("measure {} line {} {} --json", scene_, bare(first), bare(second)));
    ASSERT_EQ(measured.status, 0) << measured.err;
    // The copied places are rounded to 7 decimals of a degree: 1 cm.
    EXPECT_NEAR(nlohmann::json::parse(measured.out)["geodesic_m"].get<double>(), metres, 0.03);
    EXPECT_GT(metres, 500);
}

TEST_F(WindowTest, TheHeightUnderTheCursorIsThatOfTheFullDataWhateverTau) {
    open(std::string(kMap) + "/tau=60");
    point_at(400, 250);
    press("c");
    const std::string copied = said("coordinates ([^\n]+)");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(copied, parts, std::regex("([-0-9.]+), ([-0-9.]+), ([-0-9.]+)"))) << copied;
    const auto measured =
        relevo(fmt::format("measure {} point {},{} --json", scene_, parts.str(1), parts.str(2)));
    ASSERT_EQ(measured.status, 0) << measured.err;
    const auto json = nlohmann::json::parse(measured.out);
    const double h = json["h_m"].is_null() ? json["H_m"].get<double>() : json["h_m"].get<double>();
    EXPECT_NEAR(h, std::stod(parts.str(3)), 0.05);
}

TEST_F(WindowTest, KeysChangeTheViewAndTheStringBringsItBack) {
    open(kMap);
    point_at(400, 300);
    press("v");
    const std::string before = said("view ([^\n]+)");
    press("plus plus minus l m x 3 v");
    const std::string after = said("view [^\n]+\nview ([^\n]+)");
    EXPECT_NE(after.find("/tau=1.414"), std::string::npos) << after;
    EXPECT_NE(after.find("/wireframe=on"), std::string::npos) << after;
    EXPECT_NE(after.find("/morph=off"), std::string::npos) << after;
    EXPECT_NE(after.find("/exaggeration=1.414"), std::string::npos) << after;
    EXPECT_NE(after.find("/layer=slope"), std::string::npos) << after;
    const auto drawn = relevo(fmt::format("render {} -o {} --size 80x60 --json --at {}", scene_,
                                          (folder_ / "again.png").string(), after));
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(nlohmann::json::parse(drawn.out)["at"], after);

    desktop_.xdotool("keydown w sleep 1 keyup w");
    press("v");
    const std::string moved = said("view [^\n]+\nview [^\n]+\nview ([^\n]+)");
    EXPECT_GT(std::stod(moved), std::stod(before) + 0.001) << "W goes north here: " << moved;
}

TEST_F(WindowTest, StaysAboveTheGround) {
    open("--at 35.982222,138.017778,2600/heading=0/pitch=-5");
    desktop_.xdotool("keydown shift keydown q sleep 4 keyup q keyup shift");
    press("v");
    const std::string view = said("view ([^\n]+)");
    std::smatch parts;
    ASSERT_TRUE(std::regex_search(view, parts, std::regex("^([-0-9.]+,[-0-9.]+),([-0-9.]+)/")));
    const auto measured = relevo(fmt::format("measure {} point {} --json", scene_, parts.str(1)));
    const auto json = nlohmann::json::parse(measured.out);
    const double ground = json["h_m"].is_null() ? json["H_m"].get<double>() : json["h_m"].get<double>();
    EXPECT_NEAR(std::stod(parts.str(2)), ground + 2, 0.01);
}

TEST_F(WindowTest, ScreenshotsShowTheReadOutOverTheGround) {
    open(kMap);
    point_at(400, 300);
    press("p");
    const fs::path plain = said("screenshot ([^\n]+)");
    press("F1");
    press("v");
    said("view ([^\n]+)");  // ImGui hides a new window for the frame in which it finds its size
    press("F12");
    const fs::path with_keys = said("screenshot [^\n]+\nview [^\n]+\nscreenshot ([^\n]+)");
    ASSERT_NE(plain, with_keys);
    const auto at_rest = read_ppm(plain, folder_ / "plain.ppm");
    const auto listed = read_ppm(with_keys, folder_ / "keys.ppm");
    if (at_rest.width == 0) GTEST_SKIP() << "no program here to read PNG with";
    ASSERT_EQ(at_rest.width, 800);
    ASSERT_EQ(at_rest.height, 600);
    const auto count = [](const viewer::Picture& picture, int x0, int y0, int x1, int y1, auto&& is) {
        int pixels = 0;
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) pixels += is(picture.at(x, y));
        }
        return pixels;
    };
    const auto white = [](const std::array<int, 3>& p) { return p[0] > 200 && p[1] > 200 && p[2] > 200; };
    const auto red = [](const std::array<int, 3>& p) { return p[0] > 200 && p[1] < 90 && p[2] < 90; };
    EXPECT_GT(count(at_rest, 0, 0, 250, 160, white), 300) << "text of the view";
    EXPECT_GT(count(at_rest, 150, 560, 650, 600, white), 300) << "text of the place";
    EXPECT_GT(count(at_rest, 700, 0, 800, 100, red), 20) << "the compass's needle";
    const auto dark = [](const std::array<int, 3>& p) { return p[0] + p[1] + p[2] < 150; };
    EXPECT_GT(count(listed, 250, 150, 550, 450, dark), count(at_rest, 250, 150, 550, 450, dark) + 40000)
        << "the list of keys";
}

// Of nodes in graphics memory the mesh that is measured is made for it.
TEST_F(WindowTest, MeasuresTheErrorOfWhatIsOnTheScreen) {
    for (const char* method : {"lstr", "soar"}) {
        open(fmt::format("--lod {} --tau 2", method));
        press("F8");
        const double error_px =
            std::stod(said("Measured: ([0-9.]+) px at most, .* posts and [0-9]+ pixels, tau 2 px"));
        EXPECT_GT(error_px, 0.1) << method;
        EXPECT_LE(error_px, 2) << method;
        close();
    }
}

TEST_F(WindowTest, FliesByItselfAndClosesAfterSomeFrames) {
    start(std::string("--fly 300 --frames 12 --json ") + kMap);  // it may be gone before it is looked for
    ASSERT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    const auto json = nlohmann::json::parse(contents(folder_ / "out"));
    EXPECT_EQ(json["frames"], 12);
    EXPECT_EQ(json["width"], 800);
    EXPECT_EQ(json["height"], 600);
    EXPECT_GT(json["frame_ms_median"], 0);
    EXPECT_GE(json["frame_ms_p99"], json["frame_ms_median"]);
    EXPECT_GT(json["triangles"], 10);
    EXPECT_GT(std::stod(json["at"].get<std::string>()), 35.982222) << "it flew north";
}

TEST_F(WindowTest, RecordsWhatIsFlownAndReplaysIt) {
    const fs::path file = folder_ / "flown.flight";
    open(fmt::format("{} --record {}", kMap, file.string()));
    desktop_.xdotool("keydown w sleep 1 keyup w");
    press("v");
    const std::string end = said("view ([^\n]+)");
    press("ctrl+q");
    ASSERT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    said("flight [^\n]*flown.flight: [0-9.]+ s, [0-9]+ keys");
    const auto flown = viewer::FlightPath::load(file);
    ASSERT_TRUE(flown) << flown.error().message;
    EXPECT_GE(flown->keys().size(), 5u);
    EXPECT_NEAR(flown->keys().front().place.lat.value, 35.982222, 1e-8);
    EXPECT_NEAR(flown->keys().back().place.lat.value, std::stod(end), 1e-7);

    // To its end, and then at rest there; what was recorded stays.
    open(fmt::format("--play {} --frames 100000", file.string()));
    std::this_thread::sleep_for(std::chrono::duration<double>(flown->duration_s() + 0.5));
    press("v");
    const std::string replayed = said("view ([^\n]+)");
    EXPECT_NEAR(std::stod(replayed), flown->keys().back().place.lat.value, 1e-7);
    EXPECT_NE(replayed.find("/pitch=-90"), std::string::npos) << replayed;
    EXPECT_NE(replayed.find("/fov=30"), std::string::npos) << replayed;
    press("ctrl+q");
    EXPECT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    const auto refused = relevo(fmt::format("view {} --record {}", scene_, file.string()));
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("exists"), std::string::npos) << refused.err;
}

TEST_F(WindowTest, AKeyStopsAReplay) {
    const fs::path file = folder_ / "long.flight";
    std::ofstream(file) << "relevo-flight 1\n0 35.97 138 6000 0 -90 0 30\n600 35.99 138.02 6000 0 -90 0 30\n";
    open(fmt::format("--play {}", file.string()));
    press("v");
    const std::string stopped = said("view ([^\n]+)");
    EXPECT_GT(std::stod(stopped), 35.97);
    EXPECT_LT(std::stod(stopped), 35.98);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    press("v");
    EXPECT_EQ(said("view [^\n]+\nview ([^\n]+)"), stopped);
}

TEST_F(WindowTest, TauGrowsToABudget) {
    start(std::string("--max-triangles 500 --tau 0.25 --frames 60 --json ") + kMap);
    ASSERT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    const auto json = nlohmann::json::parse(contents(folder_ / "out"));
    EXPECT_GT(json["tau_reached_px"], 0.25);
    EXPECT_LE(json["triangles"], 500);
    EXPECT_GT(json["triangles"], 300);
    EXPECT_GT(json["frames_within_budget"], 0.3);
    EXPECT_LT(json["frames_within_budget"], 1) << "the first frames had the user's tau";
    EXPECT_NE(json["at"].get<std::string>().find("/tau=0.25/"), std::string::npos) << "the user's own";
}

TEST_F(WindowTest, ClosingTheWindowEndsTheProgramWell) {
    open(kMap);
    press("ctrl+q");
    EXPECT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    EXPECT_EQ(contents(folder_ / "err"), "");
}

TEST(Window, WithoutADisplayNamesTheWayOut) {
    SceneFolder folder;
    const std::string scene = (folder / "mountains.relevo").string();
    write_mountains(scene);
    const auto run = relevo("view " + scene, "env -u DISPLAY -u WAYLAND_DISPLAY");
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("relevo render"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace relevo::test
