// Hard case 6 and the command line's contract, as far as one source goes: exit statuses, messages,
// interruptions.
#include <csignal>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/app/run_program.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo {
namespace {

using test::SceneFolder;
using test::SyntheticRaster;

std::string quoted(const std::filesystem::path& path) {
    return "'" + path.string() + "'";
}

TEST(IngestCommand, ImportsAndSaysSoInOneObject) {
    const SceneFolder folder;
    const auto file = SyntheticRaster{}.write(folder / "a.tif");
    const auto run =
        test::relevo(fmt::format("ingest {} -o {} --json", quoted(file), quoted(folder / "a.relevo")));
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("columns"), 20);
    EXPECT_EQ(json.at("rows"), 10);
    EXPECT_EQ(json.at("posts"), 200);
    EXPECT_GT(json.at("bytes"), 0);
    EXPECT_GT(json.at("seconds"), 0);
    EXPECT_FALSE(json.at("notes").empty());
    EXPECT_TRUE(test::says(run.err, {"note:", "EGM96"}));
    EXPECT_TRUE(lod::Scene::open(folder / "a.relevo"));

    // Taken, unless told to replace it; silent if told so.
    const auto taken =
        test::relevo(fmt::format("ingest {} -o {}", quoted(file), quoted(folder / "a.relevo")));
    EXPECT_NE(taken.status, 0);
    EXPECT_TRUE(test::says(taken.err, {"--overwrite"}));
    const auto replaced = test::relevo(
        fmt::format("ingest {} -o {} --overwrite --quiet", quoted(file), quoted(folder / "a.relevo")));
    EXPECT_EQ(replaced.status, 0);
    EXPECT_EQ(replaced.err, "");
}

TEST(IngestCommand, DryRunMakesNothing) {
    const SceneFolder folder;
    const auto file = SyntheticRaster{}.write(folder / "a.tif");
    const auto run = test::relevo(
        fmt::format("ingest {} --dry-run --json -o {}", quoted(file), quoted(folder / "a.relevo")));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out).at("posts"), 200);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.relevo"));
    EXPECT_EQ(test::relevo(fmt::format("ingest {} --dry-run", quoted(file))).status, 0);
}

TEST(IngestCommand, ASceneInTheWorkingFolder) {
    const SceneFolder folder;
    SyntheticRaster{}.write(folder / "a.tif");
    const auto run = test::relevo("ingest a.tif -o a.relevo", fmt::format("cd {} &&", quoted(folder.path())));
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "a.relevo" / "scene.json"));
}

TEST(IngestCommand, ExitStatuses) {
    const SceneFolder folder;
    const auto file = quoted(SyntheticRaster{}.write(folder / "a.tif"));
    test::replace(folder / "text.tif", "no raster");
    const auto status = [&](const std::string& arguments) {
        return test::relevo("ingest " + arguments).status;
    };
    const auto out = " -o " + quoted(folder / "b.relevo");
    EXPECT_EQ(status(""), 2);
    EXPECT_EQ(status(file), 2);  // where to?
    EXPECT_EQ(status(file + out + " --memory 1MiB"), 2);
    EXPECT_EQ(status(file + out + " --resampling lanczos"), 2);
    EXPECT_EQ(status(file + out + " --bounds 1,2,3"), 2);
    EXPECT_EQ(status(file + out + " --resolution -1"), 2);
    EXPECT_EQ(status(quoted(folder / "text.tif") + out), 3);
    EXPECT_EQ(status(quoted(folder / "none.tif") + out), 3);
    EXPECT_EQ(status(file + out + " --crs EPSG:0"), 3);
    EXPECT_EQ(status(file + out + " --max-posts 100"), 3);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.relevo"));
    EXPECT_EQ(status(file + out + " --crop=10,49.95,10.1,50"), 0);
}

/// Starts an import and sends it a signal after a while; its exit status.
int interrupted_import(const std::filesystem::path& file, const std::filesystem::path& scene, int signal,
                       std::chrono::milliseconds after) {
    const pid_t child = fork();
    if (child == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        execl(RELEVO_PROGRAM, RELEVO_PROGRAM, "ingest", file.c_str(), "-o", scene.c_str(), nullptr);
        _exit(127);
    }
    std::this_thread::sleep_for(after);
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return status;
}

TEST(IngestCommand, SignalsLeaveAWholeSceneOrNothing) {
    const SceneFolder folder;
    SyntheticRaster raster;
    raster.crs = "EPSG:32632";
    raster.geotransform = {700000, 30, 0, 5200000, 0, -30};
    raster.columns = raster.rows = 600;
    raster.value = [](int c, int r) { return (c * 7919 + r * 104729) % 1000; };
    const auto file = raster.write(folder / "a.tif");
    int stopped = 0;
    for (const int signal : {SIGINT, SIGTERM})
        for (const int ms : {100, 200, 300, 500, 800}) {
            const int status =
                interrupted_import(file, folder / "a.relevo", signal, std::chrono::milliseconds{ms});
            if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
                EXPECT_TRUE(lod::Scene::open(folder / "a.relevo"));
                std::filesystem::remove_all(folder / "a.relevo");
                continue;
            }
            ++stopped;
            EXPECT_FALSE(std::filesystem::exists(folder / "a.relevo"));
            for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
                const std::string name = entry.path().filename().string();
                EXPECT_TRUE(name == "a.tif" || name.starts_with(".a.relevo.partial-"))
                    << name << " " << signal << " after " << ms << " ms";
            }
        }
    EXPECT_GT(stopped, 0);
    // What they have left goes with the next import, and is not in its way.
    EXPECT_EQ(test::relevo(fmt::format("ingest {} -o {}", quoted(file), quoted(folder / "a.relevo"))).status,
              0);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

}  // namespace
}  // namespace relevo
