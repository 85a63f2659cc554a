// Measuring in the window: editing what is measured, an area's plane, viewsheds.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geo/coordinate_text.hpp"
#include "geo/geodesic.hpp"
#include "lod/measure/height_sampler.hpp"
#include "tests/app/run_program.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/window_fixture.hpp"
#include "viewer/camera.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class WindowMeasureTest : public WindowTest {
  protected:
    static constexpr const char* kAt = "35.982222,138.017778,6000/heading=0/pitch=-90/fov=30";

    /// Two clicks one after the other are not a double one.
    void click(int x, int y, int button = 1) {
        point_at(x, y);
        wait_ms(100);
        desktop_.xdotool(fmt::format("click {}", button));
        wait_ms(450);
    }
    static void wait_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

    /// What is measured by now, as the window saves it.
    json saved() {
        wait_ms(1200);
        press("ctrl+s");
        static constexpr const char* kSaid = "measurements [^\n]+measurements-0*{}.geojson";
        said(fmt::format(fmt::runtime(kSaid), ++files_));
        return json::parse(contents(folder_ / fmt::format("measurements-{:04}.geojson", files_)));
    }

    static geo::LatLon place(const json& position) {
        return {geo::Degrees{position[1].get<double>()}, geo::Degrees{position[0].get<double>()}};
    }

    /// Where a place on the ground is in the window.
    glm::dvec2 pixel(geo::LatLon at) {
        const auto scene = lod::Scene::open(scene_);
        lod::HeightSampler sampler(*scene);
        const auto H = sampler.height(scene->info().frame.grid_position(at));
        const viewer::EyeHeight heights(scene->geoid());
        const lod::View view(viewer::camera_of(*viewer::parse_view_state(kAt), heights, 800, 600));
        return view.pixel(geo::to_ecef({at.lat, at.lon, {H->value() + heights.undulation(at).m}}) -
                          view.eye());
    }

    int files_ = 0;
};

TEST_F(WindowMeasureTest, AnyVertexIsDeletedAndOneIsDraggedOutOfASide) {
    open(std::string("--at ") + kAt);
    press("F5");
    click(300, 200);
    click(500, 220);
    click(480, 420);
    click(320, 400);
    press("Return");
    click(500, 220, 3);  // the right button, on the second
    json corners = saved()["features"][0]["geometry"]["coordinates"][0];
    ASSERT_EQ(corners.size(), 4u) << "three corners, closed";

    // Delete takes the vertex under the cursor.
    press("ctrl+z");
    point_at(480, 420);
    wait_ms(300);
    press("Delete");
    const json other = saved()["features"][0]["geometry"]["coordinates"][0];
    ASSERT_EQ(other.size(), 4u);
    EXPECT_NE(other, corners);

    // The middle of a side between two saved corners becomes a vertex where it is dropped.
    const geo::GeodesicPath side(place(other[0]), place(other[1]));
    const glm::dvec2 middle = pixel(side.at(side.length_m() / 2));
    point_at(static_cast<int>(std::lround(middle.x)), static_cast<int>(std::lround(middle.y)));
    desktop_.xdotool("mousedown 1");
    wait_ms(200);
    for (int i = 1; i <= 8; ++i)
        point_at(static_cast<int>(middle.x) + 5 * i, static_cast<int>(middle.y) - 6 * i);
    wait_ms(300);
    desktop_.xdotool("mouseup 1");
    const json after = saved()["features"][0]["geometry"]["coordinates"][0];
    ASSERT_EQ(after.size(), 5u);
    int fresh = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (std::find(other.begin(), other.end(), after[i]) != other.end()) continue;
        ++fresh;
        const glm::dvec2 there = pixel(place(after[i]));
        EXPECT_NEAR(there.x, std::floor(middle.x) + 40, 3);
        EXPECT_NEAR(there.y, std::floor(middle.y) - 48, 3);
    }
    EXPECT_EQ(fresh, 1);
    press("ctrl+z");
    EXPECT_EQ(saved()["features"][0]["geometry"]["coordinates"][0], other) << "one step";
    close();
}

// S flies backwards: with Control it did so for a frame.
TEST_F(WindowMeasureTest, CommandsDoNotMoveTheEye) {
    open(std::string("--at ") + kAt);
    press("F2");
    click(300, 200);
    saved();
    saved();
    press("v");
    said("view 35.982222,138.017778,6000/");
    close();
}

TEST_F(WindowMeasureTest, AnAreasPlaneIsChosenInThePanel) {
    open(std::string("--at ") + kAt);
    press("F5");
    click(100, 300);
    click(300, 320);
    click(280, 450);
    press("Return");
    press("Tab");
    wait_ms(800);
    const json before = saved()["features"][0]["properties"];
    EXPECT_EQ(before["plane_H_m"], before["lowest"]["H_m"]);
    click(670, 156);  // the third choice of its line, in letters of 15 pixels
    json now = saved()["features"][0];
    const json chosen = now["properties"];
    EXPECT_EQ(chosen["plane_H_m"], chosen["mean_H_m"]);
    std::string command = fmt::format("measure {} area --json --plane mean", scene_);
    // As it was clicked: rings of files are counter-clockwise.
    const json ring = now["geometry"]["coordinates"][0];
    const json corners = chosen.value("vertices", json(std::vector<json>(ring.begin(), ring.end() - 1)));
    for (const json& corner : corners)
        command += fmt::format(" {},{}", corner[1].get<double>(), corner[0].get<double>());
    const auto same = relevo(command);
    ASSERT_EQ(same.status, 0) << same.err;
    EXPECT_EQ(json::parse(same.out)["volume_above_m3"], chosen["volume_above_m3"]);
    EXPECT_EQ(json::parse(same.out)["volume_below_m3"], chosen["volume_below_m3"]);
    close();
}

TEST_F(WindowMeasureTest, AViewshedIsThatOfTheCommandLineToTheLastByte) {
    open(std::string("--at ") + kAt);
    press("F7");
    click(200, 400);
    press("Tab");
    wait_ms(1000);
    const json feature = saved()["features"][0];
    ASSERT_EQ(feature["geometry"]["type"], "Point");
    const json seen = feature["properties"];
    EXPECT_EQ(seen["radius_m"], 5000);
    EXPECT_GT(seen["visible_posts"], 10);
    const fs::path file = folder_ / "seen.tif";
    const json at = feature["geometry"]["coordinates"];
    const auto same = relevo(fmt::format("measure {} viewshed {},{} --radius 5000 --json -o {}", scene_,
                                         at[1].get<double>(), at[0].get<double>(), file.string()));
    ASSERT_EQ(same.status, 0) << same.err;
    const json command = json::parse(same.out);
    for (const char* key : {"visible_posts", "hidden_posts", "visible_area_m2", "eye_H_m"})
        EXPECT_EQ(seen[key], command[key]) << key;
    press("ctrl+shift+s");
    said("viewshed [^\n]+viewshed-0*1.tif");
    EXPECT_EQ(contents(folder_ / "viewshed-0001.tif"), contents(file));
    close();
}

TEST_F(WindowMeasureTest, ClosingDoesNotWaitForAViewshed) {
    RELEVO_NEEDS_DATA("mountains/mt_rainier_90m.tif");
    const std::string scene = (folder_ / "rainier.relevo").string();
    ASSERT_EQ(relevo(fmt::format("ingest {} -o {} --quiet",
                                 shared_data("mountains/mt_rainier_90m.tif").string(), scene))
                  .status,
              0);
    start({scene}, "--at 46.78,-121.76,9000/heading=0/pitch=-90/fov=50");
    ASSERT_TRUE(desktop_.wait_for_window());
    press("F7");
    click(200, 480);
    press("Tab");
    wait_ms(800);
    // The eye's height and the radius, in letters of 15 pixels: a line of sight to a million posts.
    for (const auto& [y, number] : {std::pair(137, "2000"), std::pair(212, "60000")}) {
        click(555, y);
        desktop_.xdotool(fmt::format("type --delay 60 {}", number));
        wait_ms(300);
        press("Return");
        wait_ms(500);
    }
    wait_ms(500);
    const auto start = std::chrono::steady_clock::now();
    press("ctrl+q");
    EXPECT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 3)
        << "the whole takes some 15 s";
}

}  // namespace
}  // namespace relevo::test
