#include "viewer/ui/file_chooser.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/lod/scratch_scene.hpp"
#include "viewer/flight/recording.hpp"
#include "viewer/ui/desk.hpp"

namespace relevo::viewer {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "x";
}

TEST(FileChooser, ListsFoldersThenScenesThenElevationFiles) {
    const test::SceneFolder folder;
    touch(folder / "b.tif");
    touch(folder / "A.HGT");
    touch(folder / "notes.txt");
    touch(folder / ".hidden.tif");
    touch(folder / "sub/x.tif");
    touch(folder / "alps.relevo/scene.json");
    const auto entries = openable_in(folder.path());
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_EQ(entries[0].name, "sub");
    EXPECT_EQ(entries[0].kind, ChooserEntry::Kind::folder);
    EXPECT_EQ(entries[1].name, "alps.relevo");
    EXPECT_EQ(entries[1].kind, ChooserEntry::Kind::scene);
    EXPECT_EQ(entries[2].name, "A.HGT");
    EXPECT_EQ(entries[3].name, "b.tif");
    EXPECT_TRUE(openable_in(folder / "nowhere").empty());
}

TEST(FileChooser, AFileInASceneIsTheScene) {
    const test::SceneFolder folder;
    touch(folder / "alps.relevo/scene.json");
    EXPECT_EQ(scene_at(folder / "alps.relevo"), folder / "alps.relevo");
    EXPECT_EQ(scene_at(folder / "alps.relevo/heights.vrt"), folder / "alps.relevo");
    EXPECT_EQ(scene_at(folder / "alps.relevo/scene.json"), folder / "alps.relevo");
    EXPECT_FALSE(scene_at(folder.path()));
    EXPECT_FALSE(scene_at(folder / "dem.tif"));
}

TEST(FreshFile, IsNoneThatIsThere) {
    const test::SceneFolder folder;
    EXPECT_EQ(fresh_file(folder.path(), "relevo", "png"), folder / "relevo-0001.png");
    touch(folder / "relevo-0001.png");
    touch(folder / "relevo-0003.png");
    EXPECT_EQ(fresh_file(folder.path(), "relevo", "png"), folder / "relevo-0002.png");
}

}  // namespace
}  // namespace relevo::viewer
