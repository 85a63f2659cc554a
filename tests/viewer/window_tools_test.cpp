// The window's tools, by keys and mouse: measuring, places, files, settings.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geo/coordinate_text.hpp"
#include "geo/geodesic.hpp"
#include "lod/scene/scene.hpp"
#include "tests/app/run_program.hpp"
#include "tests/geo/outside_program.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/window_fixture.hpp"
#include "viewer/camera.hpp"
#include "viewer/flight/flight_path.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMap = "--at 35.982222,138.017778,6000/heading=0/pitch=-90/fov=30";

nlohmann::json read_json(const fs::path& file) {
    return nlohmann::json::parse(contents(file));
}

TEST_F(WindowTest, ImportsTheFileOfTheCommandLineAndMeasuresBetweenTwoPeaks) {
    RELEVO_NEEDS_DATA("mountains/mt_rainier_90m.tif");
    const fs::path dem = folder_ / "rainier.tif";
    fs::copy_file(shared_data("mountains/mt_rainier_90m.tif"), dem);
    // Mount Adams and Mount Rainier, from straight above.
    const geo::LatLon adams{geo::Degrees{46.2024}, geo::Degrees{-121.4909}};
    const geo::LatLon rainier{geo::Degrees{46.8523}, geo::Degrees{-121.7603}};
    const std::string at = "46.53,-121.6,100000/heading=0/pitch=-90/fov=60";
    start({dem.string()}, "--at " + at);
    ASSERT_TRUE(desktop_.wait_for_window()) << contents(folder_ / "err");
    for (int i = 0; i < 300 && desktop_.xdotool("search --name rainier.relevo") != 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    ASSERT_TRUE(fs::exists(folder_ / "rainier.relevo/scene.json"));

    const auto scene = lod::Scene::open(folder_ / "rainier.relevo");
    ASSERT_TRUE(scene);
    const viewer::EyeHeight heights(scene->geoid());
    const auto state = viewer::parse_view_state(at);
    ASSERT_TRUE(state);
    const lod::View view(viewer::camera_of(*state, heights, 800, 600));
    const auto point_at_peak = [&](geo::LatLon peak, double H) {
        const geo::Ecef top = geo::to_ecef({peak.lat, peak.lon, {H + heights.undulation(peak).m}});
        const glm::dvec2 pixel = view.pixel(top - view.eye());
        point_at(static_cast<int>(std::lround(pixel.x)), static_cast<int>(std::lround(pixel.y)));
    };
    point_at_peak(adams, 3700);
    desktop_.xdotool("click 1");
    point_at_peak(rainier, 4350);
    desktop_.xdotool("click 1");
    const double metres = std::stod(said("distance ([0-9.]+) m"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // what it comes to is worked out
    press("ctrl+s");
    const fs::path saved = said("measurements ([^\n]+)");
    press("p");
    const fs::path picture = said("screenshot ([^\n]+)");
    close();

    // The same length as GeodSolve between the places that were saved; and they are the peaks, to a pixel.
    const auto line = read_json(saved)["features"][0]["geometry"]["coordinates"];
    const auto place = [&](std::size_t i) {
        return geo::LatLon{geo::Degrees{line[i][1].get<double>()}, geo::Degrees{line[i][0].get<double>()}};
    };
    EXPECT_LT(geo::geodesic(place(0), adams).length_m, 400);
    EXPECT_LT(geo::geodesic(place(1), rainier).length_m, 400);
    const auto answer =
        ask("GeodSolve -i -p 10", {fmt::format("{:.15f} {:.15f} {:.15f} {:.15f}", place(0).lat.value,
                                               place(0).lon.value, place(1).lat.value, place(1).lon.value)});
    if (!answer.empty()) {
        const std::string last = answer[0].substr(answer[0].rfind(' ') + 1);
        EXPECT_NEAR(std::stod(last), metres, 1e-4);  // it is said to 0.1 mm
    }
    EXPECT_NEAR(read_json(saved)["features"][0]["properties"]["length_m"].get<double>(), metres, 1e-4);
    EXPECT_EQ(
        std::system(
            fmt::format("ogrinfo -so -al '{}' >'{}'", saved.string(), (folder_ / "ogr").string()).c_str()),
        0);
    EXPECT_NE(contents(folder_ / "ogr").find("length_m"), std::string::npos);

    const auto seen = read_ppm(picture, folder_ / "seen.ppm");
    if (seen.width == 0) GTEST_SKIP() << "no program here to read PNG with";
    int yellow = 0;
    for (int y = 60; y < 540; ++y) {
        for (int x = 0; x < 800; ++x) {
            const auto p = seen.at(x, y);
            yellow += p[0] > 240 && p[1] > 190 && p[1] < 235 && p[2] < 60;
        }
    }
    EXPECT_GT(yellow, 300) << "the line over the ground";
}

TEST_F(WindowTest, AnAreaIsThatOfPlanimeter) {
    open(kMap);
    press("F5");
    for (const auto& [x, y] :
         {std::pair(300, 200), std::pair(500, 220), std::pair(480, 420), std::pair(320, 400)}) {
        point_at(x, y);
        desktop_.xdotool("click 1");
        std::this_thread::sleep_for(std::chrono::milliseconds(450));  // two clicks are not a double one
    }
    press("Return");
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    press("ctrl+s");
    const fs::path saved = said("measurements ([^\n]+)");
    close();
    const auto feature = read_json(saved)["features"][0];
    ASSERT_EQ(feature["geometry"]["type"], "Polygon");
    std::vector<std::string> corners;
    for (const auto& at : feature["geometry"]["coordinates"][0])
        corners.push_back(fmt::format("{:.15f} {:.15f}", at[1].get<double>(), at[0].get<double>()));
    ASSERT_EQ(corners.size(), 5u) << "a closed ring";
    corners.pop_back();
    const auto answer = ask("Planimeter -p 10", corners);
    if (answer.empty()) GTEST_SKIP() << "Planimeter is not installed";
    const std::string area = answer[0].substr(answer[0].rfind(' ') + 1);
    EXPECT_NEAR(feature["properties"]["geodesic_area_m2"].get<double>(), std::abs(std::stod(area)), 1e-2);
}

TEST_F(WindowTest, WithoutASceneOneIsChosen) {
    start(std::vector<std::string>{}, "");
    ASSERT_TRUE(desktop_.wait_for_window()) << contents(folder_ / "err");
    press("ctrl+o");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    desktop_.xdotool(fmt::format("type --delay 20 '{}'", scene_));
    press("Return");
    for (int i = 0; i < 50 && desktop_.xdotool("search --name mountains.relevo") != 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    press("v");
    said("view ([^\n]+)");
    close();
    const auto settings = read_json(folder_ / "relevo/settings.json");
    EXPECT_EQ(settings["recent"][0], scene_);
}

TEST_F(WindowTest, BrokenSettingsAreKeptAsideAndBookmarksAreKept) {
    fs::create_directories(folder_ / "relevo");
    std::ofstream(folder_ / "relevo/settings.json") << "{\"light\": maybe";
    open(kMap);
    press("b");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    close();
    EXPECT_EQ(contents(folder_ / "relevo/settings.json.broken"), "{\"light\": maybe");
    const auto settings = read_json(folder_ / "relevo/settings.json");
    ASSERT_EQ(settings["bookmarks"].size(), 1u);
    EXPECT_EQ(settings["bookmarks"][0]["scene"], scene_);
    EXPECT_TRUE(viewer::parse_view_state(settings["bookmarks"][0]["view"].get<std::string>()));
}

TEST_F(WindowTest, TurnsLightAndHidesAllAndShowsThePanel) {
    open(std::string(kMap) + " --contours auto --graticule utm");
    const auto shot = [&](const char* keys) {
        press(keys);
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        const std::string before = contents(folder_ / "out");
        press("p");
        for (int i = 0; i < 100 && contents(folder_ / "out") == before; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        const std::string out = contents(folder_ / "out");
        const auto at = out.rfind("screenshot ");
        return read_ppm(out.substr(at + 11, out.find('\n', at) - at - 11), folder_ / "look.ppm");
    };
    const auto light_pixels = [](const viewer::Picture& picture) {
        int light = 0;
        for (int y = 0; y < 30; ++y) {  // of the tool bar
            for (int x = 600; x < picture.width; ++x) {
                const auto p = picture.at(x, y);
                light += p[0] + p[1] + p[2] > 600;
            }
        }
        return light;
    };
    point_at(400, 300);
    const auto dark = shot("Escape");
    const auto light = shot("F10");
    const auto panel = shot("Tab");
    press("F10");
    const auto hidden = shot("F11");
    close();
    if (dark.width == 0) GTEST_SKIP() << "no program here to read PNG with";
    EXPECT_LT(light_pixels(dark), 1000);
    EXPECT_GT(light_pixels(light), 4000);
    EXPECT_NE(panel.at(700, 500), light.at(700, 500));
    int changed = 0;
    for (int x = 0; x < 400; ++x) changed += hidden.at(x, 18) != dark.at(x, 18);
    EXPECT_GT(changed, 200) << "no tool bar";
}

TEST_F(WindowTest, GoesToAPlaceThatIsTyped) {
    open(kMap);
    press("g");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    desktop_.xdotool("type --delay 20 '35d58N 138d1E'");
    press("Return");
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    point_at(400, 300);
    press("c");
    const auto there = geo::parse_lat_lon(said("coordinates ([-0-9.]+, [-0-9.]+), "));
    ASSERT_TRUE(there);
    const geo::LatLon wanted{geo::Degrees{35 + 58 / 60.0}, geo::Degrees{138 + 1 / 60.0}};
    EXPECT_LT(geo::geodesic(*there, wanted).length_m, 30);
    close();
}

TEST_F(WindowTest, APastedViewOfNodesThatAreNotThereIsDrawnAllTheSame) {
    open(kMap);
    press("v");
    std::string view = said("view ([^\n]+)");
    view.replace(view.find("lod=soar"), 8, "lod=lstr");
    press("g");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    desktop_.xdotool(fmt::format("type --delay 20 '{}'", view));
    press("Return");
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    press("v");
    EXPECT_NE(said("view [^\n]+\nview ([^\n]+)").find("lod=soar"), std::string::npos);
    close();
}

TEST_F(WindowTest, KeyFramesBecomeAPathAndRecordingIsAFlight) {
    open(kMap);
    press("r");
    press("k");
    desktop_.xdotool("keydown w sleep 1 keyup w");
    press("k");
    press("r");
    const auto flown = viewer::FlightPath::load(said("flight ([^\n:]+flight-[^\n:]+): "));
    EXPECT_TRUE(flown);
    press("shift+k");
    const auto path = viewer::FlightPath::load(said("path ([^\n]+)"));
    ASSERT_TRUE(path);
    ASSERT_EQ(path->keys().size(), 2u);
    EXPECT_GT(path->keys()[1].place.lat.value, path->keys()[0].place.lat.value);
    EXPECT_EQ(path->duration_s(), 4);
    close();
}

TEST_F(WindowTest, ALargePictureIsFourTimesTheWindowWithTheMarksAskedFor) {
    open(std::string(kMap) + " --marks north");
    press("ctrl+p");
    const fs::path large = said("picture ([^\n]+)");
    press("v");  // it goes on after that
    said("view ([^\n]+)");
    close();
    const auto picture = read_ppm(large, folder_ / "large.ppm");
    if (picture.width == 0) GTEST_SKIP() << "no program here to read PNG with";
    EXPECT_EQ(picture.width, 3200);
    EXPECT_EQ(picture.height, 2400);
    int needle = 0;
    int elsewhere = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto p = picture.at(x, y);
            if (p[0] > 215 && p[1] < 90 && p[2] < 80) ++(x > 2900 && y < 300 ? needle : elsewhere);
        }
    }
    EXPECT_GT(needle, 300);
    EXPECT_EQ(elsewhere, 0);
}

TEST_F(WindowTest, MiddleDragMovesTheGroundWithTheCursor) {
    open(kMap);
    point_at(400, 300);
    press("c");
    const auto before = geo::parse_lat_lon(said("coordinates ([-0-9.]+, [-0-9.]+), "));
    desktop_.xdotool("mousedown 2");
    for (int i = 1; i <= 10; ++i) point_at(400 + 12 * i, 300 + 8 * i);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    desktop_.xdotool("mouseup 2");
    press("c");
    const auto after = geo::parse_lat_lon(said("coordinates[^\n]*\ncoordinates ([-0-9.]+, [-0-9.]+), "));
    ASSERT_TRUE(before && after);
    EXPECT_LT(geo::geodesic(*before, *after).length_m, 25) << "what is held stays under the cursor";
    close();
}

}  // namespace
}  // namespace relevo::test
