#include "viewer/ui/settings.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/lod/scratch_scene.hpp"

namespace relevo::viewer {
namespace {

namespace fs = std::filesystem;

class SettingsTest : public testing::Test {
  protected:
    void write(const std::string& text) const {
        fs::create_directories(file_.parent_path());
        std::ofstream(file_) << text;
    }
    test::SceneFolder folder_;
    fs::path file_ = folder_ / "config/relevo/settings.json";
};

TEST_F(SettingsTest, ComeBackAsTheyWere) {
    Settings settings;
    settings.light = true;
    settings.ui_scale = 1.5;
    settings.units = "nautical";
    settings.panel_shown = false;
    settings.recent = {"/scenes/b.relevo", "/scenes/\"odd\" name.relevo"};
    settings.bookmarks = {{"summit", "/scenes/b.relevo", "46.85,-121.76,4500/heading=90"}};
    ASSERT_TRUE(save_settings(settings, file_));
    const auto loaded = load_settings(file_);
    EXPECT_EQ(loaded.complaint, "");
    EXPECT_EQ(loaded.settings, settings);
}

TEST_F(SettingsTest, WithoutAFileAreTheUsualOnesAndNoComplaint) {
    const auto loaded = load_settings(file_);
    EXPECT_EQ(loaded.settings, Settings());
    EXPECT_EQ(loaded.complaint, "");
}

TEST_F(SettingsTest, BrokenOnesAreSaidIgnoredAndKept) {
    for (const char* text : {"{\"light\": tru", "", "[1, 2]", "{\"light\": \"yes\"}", "{\"recent\": 3}",
                             "{\"bookmarks\": [{\"name\": \"a\"}]}", "{\"bookmarks\": 7}"}) {
        write(text);
        const auto loaded = load_settings(file_);
        EXPECT_EQ(loaded.settings, Settings()) << text;
        EXPECT_NE(loaded.complaint.find(file_.string()), std::string::npos) << text;
        ASSERT_TRUE(save_settings(loaded.settings, file_));
        EXPECT_EQ(test::contents(file_.string() + ".broken"), text);
        EXPECT_EQ(load_settings(file_).complaint, "");
    }
}

TEST_F(SettingsTest, OfANewerVersionAreReadAsFarAsTheyAreKnown) {
    write("{\"light\": true, \"hologram\": {\"depth\": 3}, \"ui_scale\": 900}");
    const auto loaded = load_settings(file_);
    EXPECT_TRUE(loaded.settings.light);
    EXPECT_EQ(loaded.settings.ui_scale, 0) << "out of its range";
    EXPECT_EQ(loaded.complaint, "");
}

TEST_F(SettingsTest, ThatCannotBeWrittenSaySo) {
    std::ofstream(folder_ / "config") << "a file where a folder is needed";
    const auto done = save_settings({}, file_);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("settings.json"), std::string::npos);
    EXPECT_FALSE(save_settings({}, {}));
}

TEST(Settings, RememberTheNewestFirstAndNotTwice) {
    Settings settings;
    for (int i = 0; i < 20; ++i) settings.remember("/scene" + std::to_string(i));
    settings.remember("/scene15");
    EXPECT_EQ(settings.recent.size(), Settings::kMostRecent);
    EXPECT_EQ(settings.recent[0], "/scene15");
    EXPECT_EQ(settings.recent[1], "/scene19");
    EXPECT_EQ(std::count(settings.recent.begin(), settings.recent.end(), "/scene15"), 1);
}

}  // namespace
}  // namespace relevo::viewer
