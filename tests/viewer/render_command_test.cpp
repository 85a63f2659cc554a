#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lod/scene/scene.hpp"
#include "lod/soar/pick.hpp"
#include "lod/view.hpp"
#include "tests/app/run_program.hpp"
#include "tests/viewer/scene_for_pictures.hpp"
#include "viewer/numbers.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;

class RenderCommand : public testing::Test {
  protected:
    RenderCommand()
        : scene_((folder_ / "mountains.relevo").string()), picture_((folder_ / "a.png").string()) {
        write_mountains(scene_);
    }

    auto render(const std::string& flags, const std::string& before = "") const {
        return relevo("render " + scene_ + " -o " + picture_ + " --size 160x90 " + flags, before);
    }

    SceneFolder folder_;
    std::string scene_;
    std::string picture_;
};

TEST_F(RenderCommand, ReportsAsOneJsonObject) {
    const auto run = render("--json --measure-error");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const auto json = nlohmann::json::parse(run.out);
    for (const char* key :
         {"lod", "tau_px", "tau_reached_px", "triangles", "draw_calls", "refine_ms", "frame_ms",
          "max_error_px", "rms_error_px", "resident_mib", "gl_renderer", "at", "ocean"}) {
        EXPECT_TRUE(json.contains(key)) << key;
    }
    EXPECT_EQ(json["lod"], "soar");
    EXPECT_EQ(json["draw_calls"], 2);
    EXPECT_GT(json["triangles"], 100);
    EXPECT_GT(json["max_error_px"], 0);
    EXPECT_LE(json["max_error_px"], 1);
    EXPECT_TRUE(json["ocean"].is_null());
    EXPECT_TRUE(fs::exists(picture_));
}

TEST_F(RenderCommand, WithoutMeasuringTheErrorIsNull) {
    const auto run = render("--json --lod full");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_TRUE(json["max_error_px"].is_null());
    EXPECT_TRUE(json["rms_error_px"].is_null());
    EXPECT_EQ(json["lod"], "full");
    EXPECT_EQ(json["triangles"], 2 * 128 * 128);
}

TEST_F(RenderCommand, ADelayThatIsNoNumberIsRefused) {
    for (const char* delay : {"abc", "-1", "1,2", "1e9", ""}) {
        const auto run = render("", std::string("RELEVO_READ_DELAY_MS=") + delay);
        EXPECT_EQ(run.status, 2) << delay;
        EXPECT_NE(run.err.find("RELEVO_READ_DELAY_MS"), std::string::npos) << run.err;
        EXPECT_FALSE(fs::exists(picture_));
    }
    EXPECT_EQ(render("", "RELEVO_READ_DELAY_MS=1.5").status, 0);
}

TEST_F(RenderCommand, TauGrowsToANumberOfTriangles) {
    const auto run = render("--json --tau 0.25 --max-triangles 700 --measure-error");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["tau_px"], 0.25);
    EXPECT_GT(json["tau_reached_px"], 0.25);
    EXPECT_LE(json["triangles"], 700);
    EXPECT_GT(json["triangles"], 500);
    EXPECT_GT(json["max_error_px"], 0.25);
    EXPECT_LE(json["max_error_px"], json["tau_reached_px"]);
    const auto enough = render("--json --tau 4 --max-triangles 700000");
    ASSERT_EQ(enough.status, 0) << enough.err;
    EXPECT_EQ(nlohmann::json::parse(enough.out)["tau_reached_px"], 4);
}

TEST_F(RenderCommand, TheViewStringGivesTheSamePicture) {
    const auto first = render("--json --heading 20 --layer slope --exaggeration 1.5 --sun 100,20");
    ASSERT_EQ(first.status, 0) << first.err;
    const std::string bytes = contents(picture_);
    const auto json = nlohmann::json::parse(first.out);
    fs::remove(picture_);
    const auto again = render("--json --at " + json["at"].get<std::string>());
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(nlohmann::json::parse(again.out)["at"], json["at"]);
    EXPECT_EQ(contents(picture_), bytes);
}

TEST_F(RenderCommand, WritesPngJpegAndTiff) {
    for (const auto& [name, magic] : {std::pair("b.png", "\x89PNG"), std::pair("b.jpg", "\xff\xd8\xff"),
                                      std::pair("b.tif", "II*"), std::pair("B.TIFF", "II*")}) {
        const auto file = folder_ / name;
        const auto run = relevo("render " + scene_ + " -o " + file.string() + " --size 40x30");
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(contents(file).substr(0, std::string(magic).size()), magic) << name;
    }
    // And nothing else: no unfinished files.
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 5);
}

TEST_F(RenderCommand, DrawsTheFramesOfAFlightAndGoesOnWhereItWasStopped) {
    const std::string flight = (folder_ / "over.flight").string();
    std::ofstream(flight) << "relevo-flight 1\n"
                             "0 35.97 138.01 6000 0 -90 0 30\n1 35.99 138.03 6000 0 -90 0 30\n";
    const auto draw = [&](const std::string& name, const std::string& flags) {
        return relevo(fmt::format("render {} -o '{}' --size 80x60 --play {} {}", scene_,
                                  (folder_ / name).string(), flight, flags));
    };
    const auto run = draw("frames/%04d.png", "--fps 4 --json");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["frames"], 5);
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(fs::exists(folder_ / fmt::format("frames/000{}.png", i)));
    EXPECT_FALSE(fs::exists(folder_ / "frames/0005.png"));
    EXPECT_NE(contents(folder_ / "frames/0000.png"), contents(folder_ / "frames/0004.png"));
    // A frame is the picture that its view string gives.
    fs::remove(folder_ / "frames/0002.png");
    const auto untouched = fs::last_write_time(folder_ / "frames/0003.png");
    ASSERT_EQ(draw("frames/%04d.png", "--fps 4").status, 0);
    EXPECT_TRUE(fs::exists(folder_ / "frames/0002.png"));
    EXPECT_EQ(fs::last_write_time(folder_ / "frames/0003.png"), untouched);
    for (const char* name : {"a.png", "%04d-%d.png", "%s.png", "%04d.gif"})
        EXPECT_EQ(draw(name, "").status, 2) << name;
    EXPECT_EQ(draw("%d.png", "--fps 0").status, 2);
    EXPECT_EQ(draw("%d.png", "--measure-error").status, 2);
}

TEST_F(RenderCommand, RefusesWhatMakesNoSense) {
    // One of each kind; what a view may be is tested with its string.
    for (const char* flags :
         {"--fov 180", "--eye 91,0,0", "--eye here", "--layer imagery", "--lod cdlod", "--metric best",
          "--morph maybe", "--sun noon", "--samples 3", "--background 0,0,256", "--at 1,2", "--size 0x10",
          "--size 10x16385", "--max-triangles 5", "--unknown"}) {
        const auto run = relevo("render " + scene_ + " -o " + picture_ + " " + flags);
        EXPECT_EQ(run.status, 2) << flags << ": " << run.err;
        EXPECT_FALSE(run.err.empty()) << flags;
    }
    EXPECT_EQ(relevo("render " + scene_ + " -o " + (folder_ / "a.bmp").string()).status, 2);
    EXPECT_EQ(relevo("render " + (folder_ / "none.relevo").string() + " -o " + picture_).status, 3);
    EXPECT_FALSE(fs::exists(picture_));
}

TEST_F(RenderCommand, AFolderThatIsNotThereIsAnErrorNotAPicture) {
    const auto run = relevo("render " + scene_ + " -o " + (folder_ / "no").string() + "/a.png --size 20x20");
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("a.png"), std::string::npos) << run.err;
}

// A driver without OpenGL 4.5, for which Mesa's older software renderer stands.
TEST_F(RenderCommand, ABrokenOpenGlIsAnErrorNotAPicture) {
    for (const char* before : {"GALLIUM_DRIVER=softpipe", "MESA_GL_VERSION_OVERRIDE=3.3",
                               "EGL_PLATFORM=none __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent"}) {
        const auto run = render("", before);
        EXPECT_EQ(run.status, 1) << before << run.err;
        EXPECT_NE(run.err.find("OpenGL"), std::string::npos) << run.err;
        EXPECT_FALSE(fs::exists(picture_));
    }
}

/// The texts of a PNG: its tEXt chunks (PNG specification, 11.3.4.3).
std::map<std::string, std::string> png_texts(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::map<std::string, std::string> texts;
    for (std::size_t at = 8; at + 8 <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8U | static_cast<unsigned char>(bytes[at + i]);
        const std::string data = bytes.substr(at + 8, length);
        const std::size_t end = data.find('\0');
        if (bytes.substr(at + 4, 4) == "tEXt" && end != std::string::npos)
            texts[data.substr(0, end)] = data.substr(end + 1);
        at += 12 + length;
    }
    return texts;
}

TEST_F(RenderCommand, WritesWhereThePictureIsIntoIt) {
    const auto run = render("--json --eye 0.3,-0.2,15000 --heading 370 --pitch -40 --fov 60 --sun 100,20");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto texts = png_texts(picture_);
    EXPECT_EQ(texts.at("crs"), "EPSG:4979");
    EXPECT_EQ(texts.at("vertical_datum"), "WGS 84 ellipsoid");
    EXPECT_EQ(std::stod(texts.at("eye_lat_deg")), 0.3);
    EXPECT_EQ(std::stod(texts.at("eye_lon_deg")), -0.2);
    EXPECT_EQ(std::stod(texts.at("eye_height_m")), 15000);
    EXPECT_EQ(std::stod(texts.at("eye_ellipsoidal_height_m")), 15000);
    EXPECT_EQ(std::stod(texts.at("heading_deg")), 10);
    EXPECT_EQ(std::stod(texts.at("pitch_deg")), -40);
    EXPECT_EQ(std::stod(texts.at("vertical_fov_deg")), 60);
    EXPECT_EQ(texts.at("size_px"), "160x90");
    EXPECT_EQ(std::stod(texts.at("sun_azimuth_deg")), 100);
    EXPECT_EQ(std::stod(texts.at("sun_elevation_deg")), 20);
    EXPECT_EQ(texts.at("scene"), "mountains.relevo");
    EXPECT_EQ(texts.at("Description"), nlohmann::json::parse(run.out)["at"]);
    EXPECT_EQ(texts.at("ground_upper_left"), "no data");  // beyond the scene
    const auto up = render("--eye 0.3,-0.2,15000 --pitch 40");
    EXPECT_EQ(up.status, 0) << up.err;
    EXPECT_EQ(png_texts(picture_).at("ground_centre"), "sky");
}

// The places are those of rays through the full data, and their heights what `relevo measure` says.
TEST_F(RenderCommand, WritesPlacesThatAgreeWithPickingAndMeasuring) {
    const auto middle = nlohmann::json::parse(relevo("info " + scene_ + " --json").out)["extent"];
    const double lat = 0.5 * (middle["south"].get<double>() + middle["north"].get<double>());
    const double lon = 0.5 * (middle["west"].get<double>() + middle["east"].get<double>());
    const auto run = render(fmt::format("--eye {},{},6000 --pitch -90 --fov 10", lat, lon));
    ASSERT_EQ(run.status, 0) << run.err;
    const auto texts = png_texts(picture_);
    const auto scene = *lod::Scene::open(scene_);
    const auto terrain = *lod::Terrain::open(scene, lod::ErrorMetric::bounded, {});
    const lod::View view({.eye = {geo::Degrees{lat}, geo::Degrees{lon}, {6000}},
                          .heading = geo::Degrees{0},
                          .pitch = geo::Degrees{-90},
                          .roll = geo::Degrees{0},
                          .fov = geo::Degrees{10},
                          .width = 160,
                          .height = 90});
    for (const auto& [key, pixel] : {std::pair("ground_centre", glm::dvec2(80, 45)),
                                     {"ground_upper_left", {0, 0}},
                                     {"ground_upper_right", {160, 0}},
                                     {"ground_lower_right", {160, 90}},
                                     {"ground_lower_left", {0, 90}}}) {
        const auto numbers = viewer::parse_numbers(texts.at(key));
        ASSERT_TRUE(numbers && numbers->size() == 3) << key << " " << texts.at(key);
        const auto hit = lod::pick_exactly(terrain, view.eye(), view.ray(pixel));
        ASSERT_TRUE(hit);
        const geo::LatLon place = terrain.frame().lat_lon(hit->place);
        EXPECT_NEAR((*numbers)[0], place.lat.value, 1e-8) << key;
        EXPECT_NEAR((*numbers)[1], place.lon.value, 1e-8) << key;
        // 1e-8 degrees are a millimetre.
        const auto measured = nlohmann::json::parse(
            relevo(fmt::format("measure {} point {:.8f},{:.8f} --json", scene_, (*numbers)[0], (*numbers)[1]))
                .out);
        EXPECT_NEAR((*numbers)[2], measured["H_m"].get<double>(), 0.01) << key;
        EXPECT_EQ((*numbers)[0] > lat, pixel.y < 45 && pixel.x != 80) << key;
    }
}

TEST_F(RenderCommand, DrawsMarksOverThePicture) {
    for (const char* wrong : {"--marks everything", "--marks all"}) {
        const auto run = render(wrong);
        EXPECT_EQ(run.status, 2) << wrong;
        EXPECT_NE(run.err.find("--marks"), std::string::npos) << run.err;
    }
    const auto picture_with = [&](const char* flags) {
        const auto run =
            relevo("render " + scene_ + " -o " + picture_ + " --size 400x300 --samples 1 " + flags);
        EXPECT_EQ(run.status, 0) << run.err;
        std::ifstream in(picture_, std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(in)), {});
    };
    const std::string none = picture_with("--marks none");
    EXPECT_NE(none, picture_with("--marks north"));
    EXPECT_EQ(picture_with("--marks labels"), none);  // of contours that are not there
}

}  // namespace
}  // namespace relevo::test
