// A scene appears whole or not at all, whoever writes, reads, dies or has a full disk meanwhile.

#include <algorithm>
#include <atomic>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "lod/scene/folder.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;
using lod::Scene;
using lod::SceneWriter;

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

using Names = std::vector<std::string>;

TEST(SceneWriter, LeavesTheSceneAndNothingElse) {
    const SceneFolder folder;
    ASSERT_TRUE(write_scene(made_up_scene(600, 9), folder / "a.relevo"));
    EXPECT_EQ(names_in(folder.path()), Names{"a.relevo"});
    EXPECT_EQ(names_in(folder / "a.relevo"),
              (Names{"geoid.tif", "heights", "heights-1", "heights-2", "heights.vrt", "marks", "scene.json",
                     "vertices-1", "vertices-2"}));
}

TEST(SceneWriter, LeavesNothingWithoutACommit) {
    const SceneFolder folder;
    {
        const SceneParts parts = made_up_scene(9, 9);
        auto writer = SceneWriter::create(folder / "a.relevo", {.overwrite = false});
        ASSERT_TRUE(writer);
        SceneWriter moved = std::move(*writer);
        ASSERT_TRUE(write_posts(moved, parts));
        EXPECT_FALSE(fs::exists(folder / "a.relevo"));
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SceneWriter, AnExistingSceneIsKeptUnlessTold) {
    const SceneFolder folder;
    ASSERT_TRUE(write_scene(made_up_scene(9, 9), folder / "a.relevo"));
    const auto refused = write_scene(made_up_scene(5, 5), folder / "a.relevo");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    EXPECT_NE(refused.error().message.find("--overwrite"), std::string::npos);
    EXPECT_EQ(Scene::open(folder / "a.relevo")->info().frame.columns, 9);

    ASSERT_TRUE(write_scene(made_up_scene(5, 5), folder / "a.relevo", true));
    EXPECT_EQ(Scene::open(folder / "a.relevo")->info().frame.columns, 5);
    EXPECT_EQ(names_in(folder.path()), Names{"a.relevo"});
}

TEST(SceneWriter, OnlyScenesAreOverwritten) {
    const SceneFolder folder;
    replace(folder / "file", "dear");
    fs::create_directory(folder / "empty");
    fs::create_directory(folder / "photos");
    replace(folder / "photos/me.png", "dear");
    ASSERT_TRUE(write_scene(made_up_scene(5, 5), folder / "with-notes"));
    replace(folder / "with-notes/notes.txt", "dear");
    for (const char* name : {"file", "empty", "photos", "with-notes"}) {
        const auto refused = write_scene(made_up_scene(9, 9), folder / name, true);
        ASSERT_FALSE(refused) << name;
        EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    }
    EXPECT_EQ(contents(folder / "file"), "dear");
    EXPECT_EQ(contents(folder / "photos/me.png"), "dear");
    EXPECT_EQ(contents(folder / "with-notes/notes.txt"), "dear");
}

TEST(SceneWriter, ASceneWithDamageOrWithStatisticsOfQgisIsOverwritten) {
    const SceneFolder folder;
    ASSERT_TRUE(write_scene(made_up_scene(5, 5), folder / "a.relevo"));
    replace(folder / "a.relevo/scene.json", "{");
    replace(folder / "a.relevo/heights.vrt.aux.xml", "<PAMDataset/>");
    ASSERT_TRUE(write_scene(made_up_scene(9, 9), folder / "a.relevo", true));
    EXPECT_EQ(Scene::open(folder / "a.relevo")->info().frame.columns, 9);
}

TEST(SceneWriter, ALinkStaysALink) {
    const SceneFolder folder;
    ASSERT_TRUE(write_scene(made_up_scene(5, 5), folder / "a.relevo"));
    fs::create_directory_symlink("a.relevo", folder / "link");
    ASSERT_TRUE(write_scene(made_up_scene(9, 9), folder / "link", true));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(Scene::open(folder / "a.relevo")->info().frame.columns, 9);
}

TEST(SceneWriter, OnlyOneWriterAtATime) {
    const SceneFolder folder;
    {
        const auto first = SceneWriter::create(folder / "a.relevo", {.overwrite = false});
        ASSERT_TRUE(first);
        const auto second = SceneWriter::create(folder / "a.relevo", {.overwrite = false});
        ASSERT_FALSE(second);
        EXPECT_NE(second.error().message.find("another Relevo"), std::string::npos) << second.error().message;
        EXPECT_TRUE(SceneWriter::create(folder / "b.relevo", {.overwrite = false}));
    }
    EXPECT_TRUE(SceneWriter::create(folder / "a.relevo", {.overwrite = false}));
}

TEST(SceneWriter, ManyWritersAtOnceLeaveOneWholeScene) {
    const SceneFolder folder;
    std::atomic<int> written = 0;
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 8; ++i) {
            threads.emplace_back([&, i] {
                for (int turn = 0; turn < 5; ++turn) {
                    if (write_scene(made_up_scene(5 + i, 5 + i), folder / "a.relevo", true)) ++written;
                }
            });
        }
    }
    EXPECT_GT(written, 0);
    const auto scene = Scene::open(folder / "a.relevo");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->verify().empty());
    EXPECT_EQ(names_in(folder.path()), Names{"a.relevo"});
}

TEST(SceneWriter, AReaderKeepsWhatItOpened) {
    const SceneFolder folder;
    const SceneParts old = made_up_scene(700, 20);
    ASSERT_TRUE(write_scene(old, folder / "a.relevo"));
    {
        const auto reader = Scene::open(folder / "a.relevo");
        ASSERT_TRUE(reader);
        ASSERT_TRUE(write_scene(made_up_scene(9, 9), folder / "a.relevo", true));
        ASSERT_TRUE(write_scene(made_up_scene(8, 8), folder / "a.relevo", true));
        const auto heights = reader->read_all_heights();
        ASSERT_TRUE(heights) << heights.error().message;
        EXPECT_TRUE(same_bits(*heights, old.heights));
        EXPECT_TRUE(reader->verify().empty());
    }
    EXPECT_EQ(Scene::open(folder / "a.relevo")->info().frame.columns, 8);
    // The next writer sweeps what the reader was holding.
    ASSERT_TRUE(write_scene(made_up_scene(7, 7), folder / "a.relevo", true));
    EXPECT_EQ(names_in(folder.path()), Names{"a.relevo"});
}

/// Runs work in a process of its own; its exit status, or minus the signal that ended it.
template <class Work>
int in_child(const Work& work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(SceneWriter, AKilledWriterBlocksNobodyAndIsSwept) {
    const SceneFolder folder;
    EXPECT_EQ(in_child([&] {
                  const auto writer = SceneWriter::create(folder / "a.relevo", {.overwrite = false});
                  kill(getpid(), SIGKILL);
              }),
              -SIGKILL);
    EXPECT_EQ(names_in(folder.path()).size(), 2U);  // the lock and the part
    EXPECT_FALSE(fs::exists(folder / "a.relevo"));
    ASSERT_TRUE(write_scene(made_up_scene(5, 5), folder / "a.relevo"));
    EXPECT_EQ(names_in(folder.path()), Names{"a.relevo"});
}

TEST(SceneWriter, NoFolderToWriteIn) {
    const SceneFolder folder;
    const auto missing = SceneWriter::create(folder / "no/such/a.relevo", {.overwrite = false});
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("no/such"), std::string::npos) << missing.error().message;
    for (const char* nowhere : {"", "/", "."})
        EXPECT_FALSE(SceneWriter::create(nowhere, {.overwrite = true})) << nowhere;
    EXPECT_FALSE(SceneWriter::create("/proc/a.relevo", {.overwrite = false}));
}

/// A limit on the size of files fails a write just as a full disk does, and needs no disk.
TEST(Folder, AWriteThatFailsSaysWhy) {
    const SceneFolder folder;
    EXPECT_EQ(in_child([&] {
                  std::signal(SIGXFSZ, SIG_IGN);
                  const rlimit limit{1000, 1000};
                  setrlimit(RLIMIT_FSIZE, &limit);
                  const auto opened = lod::Folder::open(folder.path());
                  const auto done = opened->write("big", std::vector<std::byte>(5000));
                  const bool clear = !done && done.error().kind == ErrorKind::internal &&
                                     done.error().message.find("big: File too large") != std::string::npos;
                  _exit(clear ? 42 : 1);
              }),
              42);
}

}  // namespace
}  // namespace relevo::test
