// What happens to a file that is dropped on the window or chosen in it. xdotool cannot drop: GLFW's callback
// is called, and then what a frame calls for each path.
#define GLFW_INCLUDE_NONE
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "ingest/file_content.hpp"
#include "tests/ingest/synthetic_raster.hpp"
#include "tests/viewer/desktop.hpp"
#include "tests/viewer/scene_for_pictures.hpp"
#include "tests/viewer/studio.hpp"
#include "viewer/flight/flight_files.hpp"
#include "viewer/flight/flight_state.hpp"

namespace relevo::viewer {
namespace {

namespace fs = std::filesystem;
using test::SyntheticRaster;

/// One texel everywhere.
class PlainDrape final : public Drape {
  public:
    PlainDrape(std::string name, bool lines) : name_(std::move(name)), lines_(lines) {}
    std::string name() const override { return name_; }
    int finer() const override { return 0; }
    std::optional<std::array<std::uint8_t, 3>> line_colour() const override {
        if (!lines_) return std::nullopt;
        return std::array<std::uint8_t, 3>{9, 9, 9};
    }
    Result<DrapeTexels> read(const Page&) const override {
        return DrapeTexels(static_cast<std::size_t>(kPagePosts) * kPagePosts, {9, 9, 9, 255});
    }

  private:
    std::string name_;
    bool lines_;
};

LayerFiles files() {
    const auto uses_of = [](const fs::path& file) {
        std::vector<FileUse> uses;
        if (file.extension() == ".geojson") uses.push_back(FileUse::measurements);
        for (const auto content : ingest::contents_of(file.string()))
            uses.push_back(content == ingest::FileContent::imagery   ? FileUse::imagery
                           : content == ingest::FileContent::vectors ? FileUse::vectors
                                                                     : FileUse::elevation);
        return uses;
    };
    const auto open = [](const fs::path& file, FileUse use, const geo::GridFrame&,
                         std::size_t) -> Result<std::shared_ptr<const Drape>> {
        if (file.stem() == "bad") return Error{ErrorKind::input, "bad.tif: it has no georeference."};
        return std::shared_ptr<const Drape>(
            std::make_shared<PlainDrape>(file.filename().string(), use == FileUse::vectors));
    };
    return {uses_of, open};
}

class OpenPath : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v Xvfb >/dev/null") != 0) GTEST_SKIP() << "Xvfb is not installed";
        ASSERT_TRUE(desktop_.start());
        setenv("DISPLAY", desktop_.display().c_str(), 1);
        unsetenv("WAYLAND_DISPLAY");
        test::write_mountains((folder_ / "mountains.relevo").string());
        scene_.emplace(test::must(lod::Scene::open(folder_ / "mountains.relevo")));
        terrain_.emplace(test::must(lod::Terrain::open(*scene_, lod::ErrorMetric::bounded, {})));
        heights_.emplace(scene_->geoid());
        options_.layers = files();
        options_.files.load = [](const fs::path&) {
            return Result<std::vector<lod::Measurement>>(
                {{"a", lod::MeasurementKind::point, {{geo::Degrees{1}, geo::Degrees{2}}}}});
        };
        options_.say = [this](const std::string& line) { said_ += line + "\n"; };
        desk_.emplace(test::must(Desk::create(
            {.width = 400,
             .height = 300,
             .make_scene = [](const fs::path&, const std::function<bool(double)>&) -> Result<fs::path> {
                 return Error{ErrorKind::input, "no heights in it"};
             },
             .uses_of = options_.layers.uses_of})));
        flight_ = std::make_unique<FlightState>(*desk_, *scene_, *terrain_, test::ground_of(*terrain_),
                                                *heights_, ViewState{}, options_);
    }

    /// What the window hands to a frame when these are dropped on it.
    std::vector<std::string> dropped(std::vector<const char*> paths) {
        Window& window = desk_->window();
        const auto callback = glfwSetDropCallback(window.handle(), nullptr);
        glfwSetDropCallback(window.handle(), callback);
        callback(window.handle(), static_cast<int>(paths.size()), paths.data());
        return window.poll(0).dropped;
    }

    /// Drops a file and waits for what is done with it in the background.
    void drop(const fs::path& file) {
        for (const std::string& path : dropped({file.c_str()})) open_path(*flight_, path);
        settle();
    }
    void settle() {
        while (flight_->layers.opening()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            const auto opened = flight_->layers.take_opened();
            if (opened && !*opened) flight_->tell(opened->error().message);
        }
    }

    test::SceneFolder folder_;
    test::Desktop desktop_;
    std::optional<lod::Scene> scene_;
    std::optional<lod::Terrain> terrain_;
    std::optional<EyeHeight> heights_;
    FlightOptions options_;
    std::string said_;
    std::optional<Desk> desk_;
    std::unique_ptr<FlightState> flight_;
};

TEST_F(OpenPath, WhatIsDroppedArrivesInOrder) {
    EXPECT_EQ(dropped({"/a/b.tif", "/c d.gpx"}), (std::vector<std::string>{"/a/b.tif", "/c d.gpx"}));
    EXPECT_TRUE(desk_->window().poll(0).dropped.empty()) << "once";
}

TEST_F(OpenPath, PicturesAndLinesLieOverTheGround) {
    drop(SyntheticRaster{.bands = 3, .type = GDT_Byte}.write(folder_ / "ortho.tif"));
    EXPECT_TRUE(flight_->layers.take_changed());
    std::ofstream(folder_ / "way.gpx")
        << "<gpx version='1.1' creator='t' xmlns='http://www.topografix.com/GPX/1/1'><wpt lat='46' "
           "lon='8'/></gpx>";
    drop(folder_ / "way.gpx");
    EXPECT_EQ(to_string(flight_->view.overlays), "imagery:0:1,vectors:1:1");
    ASSERT_EQ(flight_->ground.drapes.size(), 2u);
    EXPECT_EQ(flight_->ground.drapes[0]->name(), "ortho.tif");
    flight_->layers.remove(0);
    EXPECT_EQ(to_string(flight_->view.overlays), "vectors:0:1");
    EXPECT_TRUE(flight_->layers.take_changed());
    EXPECT_FALSE(flight_->layers.take_changed());
}

TEST_F(OpenPath, HeightsAreImported) {
    drop(SyntheticRaster{}.write(folder_ / "dem.tif"));
    ASSERT_NE(desk_->import(), nullptr);
    EXPECT_EQ(desk_->import()->file().filename(), "dem.tif");
    EXPECT_TRUE(flight_->ground.drapes.empty());
}

TEST_F(OpenPath, ASceneIsOpenedNext) {
    drop(folder_ / "mountains.relevo");
    EXPECT_EQ(desk_->take_next(), folder_ / "mountains.relevo");
}

TEST_F(OpenPath, WhatMayBeSeveralIsAsked) {
    const fs::path grey = SyntheticRaster{.type = GDT_Byte}.write(folder_ / "grey.tif");
    drop(grey);
    EXPECT_FALSE(flight_->layers.opening());
    EXPECT_EQ(desk_->import(), nullptr);
    EXPECT_FALSE(flight_->panels.answer({.number = GLFW_KEY_3})) << "there are two";
    const auto second = flight_->panels.answer({.number = GLFW_KEY_2});
    ASSERT_TRUE(second);
    EXPECT_EQ(second->use, FileUse::elevation);
    EXPECT_FALSE(flight_->panels.answer({.number = GLFW_KEY_1})) << "it is answered";
    drop(grey);
    const auto first = flight_->panels.answer({.number = GLFW_KEY_ENTER});
    ASSERT_TRUE(first);
    ASSERT_EQ(first->use, FileUse::imagery);
    open_as(*flight_, first->text, first->use);
    settle();
    EXPECT_EQ(flight_->ground.drapes.size(), 1u);
    drop(grey);
    EXPECT_TRUE(flight_->panels.close()) << "Escape: nothing";
    EXPECT_FALSE(flight_->panels.answer({.number = GLFW_KEY_ENTER}));
}

TEST_F(OpenPath, MeasurementsAreMeasured) {
    std::ofstream(folder_ / "m.geojson") << R"({"type":"Point","coordinates":[2,1]})";
    drop(folder_ / "m.geojson");
    const auto first = flight_->panels.answer({.number = GLFW_KEY_ENTER});
    ASSERT_TRUE(first);
    EXPECT_EQ(first->use, FileUse::measurements);
    open_as(*flight_, first->text, first->use);
    EXPECT_EQ(flight_->measuring.tool().shapes().size(), 1u);
}

TEST_F(OpenPath, ABadFileSaysSoInTheWindow) {
    drop(SyntheticRaster{.bands = 3, .type = GDT_Byte}.write(folder_ / "bad.tif"));
    EXPECT_EQ(desk_->message(), "bad.tif: it has no georeference.");
    EXPECT_TRUE(flight_->ground.drapes.empty());
    EXPECT_EQ(to_string(flight_->view.overlays), "none");
    drop(folder_ / "nowhere.tif");
    EXPECT_NE(desk_->message().find("no such file"), std::string::npos) << desk_->message();
    std::ofstream(folder_ / "notes.tif") << "no picture";
    drop(folder_ / "notes.tif");
    for (int i = 0; i < 500 && desk_->import() != nullptr; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        desk_->see_to_import();
    }
    EXPECT_EQ(desk_->message(), "no heights in it") << "what the import says";
}

TEST_F(OpenPath, TheFifthIsRefused) {
    const fs::path file = SyntheticRaster{.bands = 3, .type = GDT_Byte}.write(folder_ / "ortho.tif");
    for (int i = 0; i < 5; ++i) drop(file);
    EXPECT_EQ(flight_->ground.drapes.size(), GroundData::kMostDrapes);
    EXPECT_NE(desk_->message().find("take one away"), std::string::npos) << desk_->message();
}

TEST_F(OpenPath, WithoutASceneAPictureIsNone) {
    desk_->open(SyntheticRaster{.bands = 3, .type = GDT_Byte}.write(folder_ / "ortho.tif"));
    EXPECT_EQ(desk_->import(), nullptr);
    EXPECT_NE(desk_->message().find("open a scene first"), std::string::npos) << desk_->message();
}

TEST_F(OpenPath, AViewshedIsShownInstead) {
    const auto shed = [] {
        auto made = std::make_shared<lod::Viewshed>();
        made->box = {0, 0, 3, 3};
        made->posts = lod::Raster<std::uint8_t>(3, 3, lod::Viewshed::visible);
        return std::shared_ptr<const lod::Viewshed>(made);
    };
    const auto first = shed();
    EXPECT_TRUE(flight_->layers.show_viewshed(first));
    EXPECT_TRUE(flight_->layers.take_changed());
    EXPECT_TRUE(flight_->layers.show_viewshed(first));
    EXPECT_FALSE(flight_->layers.take_changed()) << "it is there";
    drop(SyntheticRaster{.bands = 3, .type = GDT_Byte}.write(folder_ / "ortho.tif"));
    flight_->view.overlays[0].opacity = 0.25;
    EXPECT_TRUE(flight_->layers.show_viewshed(shed()));
    EXPECT_EQ(to_string(flight_->view.overlays), "imagery:0:0.25,imagery:1:1") << "its place stays";
    EXPECT_TRUE(flight_->layers.show_viewshed(nullptr));
    EXPECT_EQ(to_string(flight_->view.overlays), "imagery:0:1");
    EXPECT_EQ(flight_->ground.drapes[0]->name(), "ortho.tif");
}

}  // namespace
}  // namespace relevo::viewer
