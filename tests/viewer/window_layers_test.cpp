// Layers in the window: added from files, put in order, switched off.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/run_program.hpp"
#include "tests/ingest/synthetic_raster.hpp"
#include "tests/viewer/window_fixture.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class WindowLayersTest : public WindowTest {
  protected:
    static constexpr const char* kMap =
        "--at 35.982222,138.017778,6000/heading=0/pitch=-90/fov=30 --ocean off";

    static void wait_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

    /// A picture of magenta over all of the scene.
    fs::path write_picture(const char* name) {
        return SyntheticRaster{.columns = 64,
                               .rows = 64,
                               .bands = 3,
                               .geotransform = {137.9, 0.004, 0, 36.1, 0, -0.004},
                               .type = GDT_Byte,
                               .value = [](int, int) { return 255.0; },
                               .interpretations = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand}}
            .write(folder_ / name);
    }

    void choose(const fs::path& file) {
        press("ctrl+o");
        wait_ms(500);
        desktop_.xdotool(fmt::format("type --delay 20 '{}'", file.string()));
        press("Return");
    }

    /// How many pixels of a screenshot without panels are nearly white.
    int white_pixels() {
        press("F11");
        wait_ms(700);
        const std::string before = contents(folder_ / "out");
        press("p");
        for (int i = 0; i < 100 && contents(folder_ / "out") == before; ++i) wait_ms(100);
        press("F11");
        const std::string out = contents(folder_ / "out") + contents(folder_ / "err");
        const auto at = out.rfind("screenshot ");
        const auto seen = read_ppm(out.substr(at + 11, out.find('\n', at) - at - 11), folder_ / "look.ppm");
        int white = 0;
        for (int y = 0; y < seen.height; ++y) {
            for (int x = 0; x < seen.width; ++x) {
                const auto p = seen.at(x, y);
                white += p[0] > 250 && p[1] > 250 && p[2] > 250;
            }
        }
        return white;
    }

    std::string last_view() {
        const std::string before = contents(folder_ / "out") + contents(folder_ / "err");
        press("v");
        for (int i = 0; i < 100; ++i) {
            const std::string out = contents(folder_ / "out") + contents(folder_ / "err");
            const auto at = out.rfind("view ");
            if (out != before && at != std::string::npos) return out.substr(at, out.find('\n', at) - at);
            wait_ms(50);
        }
        return {};
    }

    void go_to(std::string view) {
        press("g");
        wait_ms(400);
        desktop_.xdotool(fmt::format("type --delay 15 '{}'", view));
        press("Return");
        wait_ms(1500);
    }
};

TEST_F(WindowLayersTest, PicturesAndLinesAreChosenAndPutInOrder) {
    const fs::path picture = write_picture("white.tif");
    std::ofstream(folder_ / "way.gpx")
        << "<gpx version='1.1' creator='t' xmlns='http://www.topografix.com/GPX/1/1'>"
           "<wpt lat='35.98' lon='138.01'/></gpx>";
    std::ofstream(folder_ / "bad.tif") << "no picture";
    open(std::string(kMap) + " --contours 50");
    const int before = white_pixels();
    choose(picture);
    said("layer white.tif");
    wait_ms(1500);
    const int after = white_pixels();
    if (after > 0 || before > 0) {  // else no program here reads PNG
        EXPECT_GT(after, before + 200000) << "it is over most of the window";
    }
    choose(folder_ / "way.gpx");
    said("layer way.gpx");
    EXPECT_NE(last_view().find("/overlays=imagery:0:1,vectors:1:1,contours:50:1"), std::string::npos);
    press("o");  // the uppermost
    wait_ms(200);
    press("shift+o");  // becomes the lowest
    wait_ms(200);
    EXPECT_NE(last_view().find("/overlays=contours:50:1,imagery:0:1,vectors:1:1"), std::string::npos);
    choose(folder_ / "bad.tif");
    wait_ms(700);
    EXPECT_FALSE(last_view().empty()) << "it goes on";
    close();
}

TEST_F(WindowLayersTest, APictureIsTakenAwayInThePanel) {
    const fs::path picture = write_picture("white.tif");
    open(std::string(kMap) + " --imagery " + picture.string());
    press("Tab");
    wait_ms(700);
    EXPECT_NE(last_view().find("/overlays=imagery:0:1"), std::string::npos);
    point_at(781, 332);  // the last button of its row, in letters of 15 pixels
    wait_ms(200);
    desktop_.xdotool("click 1");
    wait_ms(700);
    point_at(200, 400);
    wait_ms(300);
    EXPECT_EQ(last_view().find("imagery"), std::string::npos);
    close();
}

TEST_F(WindowLayersTest, AGreyPictureIsAskedAbout) {
    const fs::path grey =
        SyntheticRaster{
            .columns = 64, .rows = 64, .geotransform = {137.9, 0.004, 0, 36.1, 0, -0.004}, .type = GDT_Byte}
            .write(folder_ / "grey.tif");
    open(kMap);
    choose(grey);
    wait_ms(700);
    press("1");
    said("layer grey.tif");
    const std::string view = last_view();
    EXPECT_NE(view.find("/overlays=imagery:0:1"), std::string::npos);
    EXPECT_NE(view.find("/layer=hypsometric"), std::string::npos) << "1 was the answer";
    close();
}

/// What a run says of itself at its end.
class WindowCountersTest : public WindowLayersTest {
  protected:
    json figures_of(const std::string& flags) {
        start(std::string(kMap) + " --json --frames 6 " + flags);
        EXPECT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
        return json::parse(contents(folder_ / "out"));
    }
};

TEST_F(WindowCountersTest, ALayerThatIsOffMakesNoGlObjectAndLoadsNoTile) {
    const fs::path picture = write_picture("white.tif");
    const json never = figures_of("");
    EXPECT_EQ(never["overlays"], json::array());
    EXPECT_GT(never["gl_objects"]["textures"], 0);

    const json on = figures_of("--contours auto --imagery " + picture.string());
    ASSERT_EQ(on["overlays"].size(), 2u);
    EXPECT_EQ(on["overlays"][0]["overlay"], "imagery:0:1");
    EXPECT_GE(on["overlays"][0]["tiles"], 1);
    EXPECT_EQ(on["overlays"][0]["gl_objects"], 3);
    EXPECT_GT(on["overlays"][0]["bytes"], 0);
    EXPECT_EQ(on["overlays"][1]["tiles"], 0);
    EXPECT_EQ(on["gl_objects"]["textures"], never["gl_objects"]["textures"].get<int>() + 2);
    EXPECT_EQ(on["gl_objects"]["buffers"], never["gl_objects"]["buffers"].get<int>() + 2);
}

TEST_F(WindowCountersTest, ALayerThatIsSwitchedOffLeavesNothingBehind) {
    const json never = figures_of("");
    const fs::path picture = write_picture("white.tif");
    open(std::string(kMap) + " --json --contours auto --graticule utm --imagery " + picture.string());
    std::string view = last_view().substr(5);
    const auto from = view.find("/overlays=");
    ASSERT_NE(from, std::string::npos) << view;
    view.erase(from, view.find('/', from + 1) - from);
    go_to(view + "/overlays=none");
    EXPECT_EQ(last_view().find("imagery"), std::string::npos);
    close();
    const json off = json::parse(contents(folder_ / "out"));
    EXPECT_EQ(off["overlays"], json::array());
    for (const auto& [kind, count] : never["gl_objects"].items()) {
        if (kind == "programs") continue;
        EXPECT_EQ(off["gl_objects"][kind], count) << kind;
    }
    EXPECT_EQ(off["gl_objects"]["programs"], never["gl_objects"]["programs"].get<int>() + 1)
        << "the ground's with overlays is kept for the next time";
}

TEST_F(WindowCountersTest, AFileWhoseLayerIsOffFromTheBeginningIsNotLoaded) {
    const fs::path picture = write_picture("white.tif");
    const json never = figures_of("");
    start(std::string("--json --frames 6 --ocean off --imagery ") + picture.string() +
          " --layer plain --at 35.982222,138.017778,6000/heading=0/pitch=-90/fov=30");
    EXPECT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    const json plain = json::parse(contents(folder_ / "out"));
    EXPECT_EQ(plain["overlays"], json::array()) << "the plain layer takes none";
    EXPECT_LE(plain["gl_objects"]["textures"], never["gl_objects"]["textures"]);
    EXPECT_EQ(plain["gl_objects"]["buffers"], never["gl_objects"]["buffers"]);
}

}  // namespace
}  // namespace relevo::test
