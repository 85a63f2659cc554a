// `relevo bench` as people and scripts use it: its files, its JSON, what it refuses.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/app/run_program.hpp"
#include "tests/shared_data.hpp"
#include "tests/viewer/scene_for_pictures.hpp"
#include "viewer/flight/flight_path.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;

class BenchCommand : public testing::Test {
  protected:
    BenchCommand() : scene_((folder_ / "mountains.relevo").string()), out_(folder_ / "out") {
        write_mountains(scene_);
    }

    auto bench(const std::string& flags) const {
        return relevo(fmt::format("bench {} -o {} --size 160x90 {}", scene_, out_.string(), flags));
    }

    /// Lines of a CSV file, each of as many fields as the first.
    static std::size_t csv_rows(const fs::path& file) {
        std::istringstream lines(contents(file));
        std::string line;
        std::size_t rows = 0;
        std::ptrdiff_t commas = -1;
        while (std::getline(lines, line)) {
            const auto here = std::count(line.begin(), line.end(), ',');
            if (commas < 0) commas = here;
            EXPECT_EQ(here, commas) << line;
            ++rows;
        }
        return rows - 1;  // without the names
    }

    SceneFolder folder_;
    std::string scene_;
    fs::path out_;
};

TEST_F(BenchCommand, LeavesFiguresAndAPage) {
    const auto run = bench("--quick --frames 3 --budget 100 --json");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const auto json = nlohmann::json::parse(run.out);
    auto kept = nlohmann::json::parse(contents(out_ / "bench.json"));
    EXPECT_EQ(json["folder"], out_.string());
    kept["folder"] = out_.string();
    EXPECT_EQ(kept, json);
    for (const char* key : {"command", "scene", "flight", "machine", "width_px", "frames", "runs", "rows",
                            "skipped", "morph_price", "budget_ms", "jump_step_s", "seconds"}) {
        EXPECT_TRUE(json.contains(key)) << key;
    }
    EXPECT_NE(json["command"].get<std::string>().find("--quick"), std::string::npos);
    EXPECT_EQ(json["width_px"], 160);
    EXPECT_EQ(json["scene"]["posts"], 129 * 129);
    EXPECT_GT(json["machine"]["cores"], 0);

    // 3 taus: two metrics and lstr, each with the morph and without it; the textbook; full; two rows with a
    // budget.
    const auto& rows = json["rows"];
    ASSERT_EQ(rows.size(), 3u * 2 * 3 + 3 + 1 + 2);
    std::set<std::string> methods;
    for (const auto& row : rows) {
        const std::string method = row["method"];
        methods.insert(method);
        EXPECT_GT(row["triangles"]["median"], 0) << method;
        EXPECT_GE(row["frame_ms"]["p99"], row["frame_ms"]["median"]);
        EXPECT_GE(row["frame_ms"]["median"], row["refine_ms"]["median"]);
        EXPECT_GT(row["resident_mib"], 10);
        EXPECT_GE(row["mesh_bytes_per_vertex"], 16);
        if (row["by_budget"]) {
            EXPECT_GE(row["tau_reached_px"]["least"], 1);
            EXPECT_GE(row["frames_within_budget"], 0);
            EXPECT_LE(row["frames_within_budget"], 1);
            continue;
        }
        ASSERT_FALSE(row["max_error_px"].is_null()) << method;
        EXPECT_GE(row["max_error_px"], row["rms_error_px"]);
        if (method == "full") {
            EXPECT_LT(row["max_error_px"], 0.01);
            EXPECT_TRUE(row["tau_px"].is_null() && row["max_jump_px"].is_null());
            EXPECT_EQ(row["triangles"]["median"], 2 * 128 * 128);
            continue;
        }
        EXPECT_FALSE(row["max_jump_px"].is_null()) << method;
        if (method == "soar-bounded") {
            EXPECT_LE(row["max_error_px"], row["tau_px"]) << "the bound";
            EXPECT_EQ(row["uncovered_posts"], 0);
        }
        if (method != "textbook") {
            EXPECT_GT(row["refine_time_to_textbook"]["median"], 0);
        }
    }
    EXPECT_EQ(methods,
              (std::set<std::string>{"full", "lstr", "soar-bounded", "soar-incremental", "textbook"}));
    EXPECT_EQ(json["morph_price"].size(), 9u);
    EXPECT_TRUE(json["ocean"].is_array() && json["ocean"].empty()) << "there is no sea";
    EXPECT_TRUE(json["ocean_at"].is_null() && json["ocean_left_out"].is_null());
    EXPECT_FALSE(fs::exists(out_ / "ocean.csv"));
    EXPECT_EQ(csv_rows(out_ / "bench.csv"), rows.size());
    std::size_t frames = 0;
    for (const auto& row : rows) frames += row["frames"].get<std::size_t>();
    EXPECT_EQ(csv_rows(out_ / "frames.csv"), frames);

    // The page needs nothing else, and has all its plots.
    const std::string page = contents(out_ / "bench.html");
    for (const char* outside : {"http:", "https:", "src=", "href=", "url(", "@import", "<script"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    std::size_t plots = 0;
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++plots;
    EXPECT_EQ(plots, 6u);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_NE(page.find("355 MB"), std::string::npos);
    EXPECT_NE(page.find("</html>"), std::string::npos);

    // What was flown can be flown again.
    const auto flight = viewer::FlightPath::load(out_ / "flight.txt");
    ASSERT_TRUE(flight) << flight.error().message;
    EXPECT_EQ(flight->duration_s(), 60);
}

TEST_F(BenchCommand, MeasuresTheSea) {
    RELEVO_NEEDS_DATA("coast/N43E007.hgt.zip");
    const auto imported = relevo("ingest " + shared_data("coast/N43E007.hgt.zip").string() + " -o " + scene_ +
                                 " --quiet --overwrite");
    ASSERT_EQ(imported.status, 0) << imported.err;
    const std::string one_frame =
        "--methods soar-bounded --morph off --taus 8 --frames 1 --runs 1 --error-every 0 --overwrite --json ";
    const auto run = bench(one_frame);
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    const auto& rows = json["ocean"];
    ASSERT_EQ(rows.size(), 3u * 2 * 3 * 2) << "meshes, sizes, heights and directions";
    EXPECT_LT(json["ocean_at"][0], 43.6) << "the sea is in the south";
    EXPECT_TRUE(json["ocean_left_out"].is_null());
    std::set<std::string> meshes;
    for (const auto& row : rows) {
        meshes.insert(row["mesh"]);
        EXPECT_EQ(row["holes"], 0) << row;
        EXPECT_GT(row["triangles"], 0) << row;
        EXPECT_GE(row["vertices"], 4) << row;
        EXPECT_GE(row["draw_calls"], 1) << row;
        EXPECT_GT(row["cpu_ms"], 0) << row;
        EXPECT_GT(row["gpu_ms"], 0) << row;
        ASSERT_GT(row["error_pixels"], 0) << row;
        EXPECT_GT(row["max_error_px"], 0) << row;
        EXPECT_GE(row["max_error_px"], row["rms_error_px"]) << row;
        // The projected grid has a most of vertices, which is too few along the horizon.
        if (row["mesh"] != "projected") {
            EXPECT_LE(row["max_error_px"], 1.05 * row["asked_px"].get<double>()) << row;
        }
    }
    EXPECT_EQ(meshes, (std::set<std::string>{"geoclipmap", "projected", "radial"}));
    EXPECT_EQ(csv_rows(out_ / "ocean.csv"), rows.size());
    const std::string page = contents(out_ / "bench.html");
    EXPECT_NE(page.find("swimming"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);

    const auto radial = bench(one_frame + "--quick --ocean radial --ocean-at 43.4,7.5");
    ASSERT_EQ(radial.status, 0) << radial.err;
    const auto alone = nlohmann::json::parse(radial.out);
    EXPECT_EQ(alone["ocean"].size(), 6u);
    EXPECT_EQ(alone["ocean_at"], nlohmann::json({43.4, 7.5}));

    fs::remove_all(out_);
    const auto off = bench(one_frame + "--ocean off");
    ASSERT_EQ(off.status, 0) << off.err;
    EXPECT_TRUE(nlohmann::json::parse(off.out)["ocean"].empty());
    EXPECT_FALSE(fs::exists(out_ / "ocean.csv"));
}

TEST_F(BenchCommand, FliesWhatItIsTold) {
    const fs::path file = folder_ / "down.flight";
    replace(file, "relevo-flight 1\n0 35.97 138.02 4000 0 -40 0 50\n3 35.98 138.02 3000 0 -40 0 50\n");
    const auto run = bench(fmt::format(
        "--flight {} --methods soar-bounded --morph off --taus 4,1 --frames 3 --runs 2 --error-every 0",
        file.string()));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("soar-bounded"), std::string::npos) << run.out;
    const auto json = nlohmann::json::parse(contents(out_ / "bench.json"));
    EXPECT_EQ(json["flight"]["duration_s"], 3);
    ASSERT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][0]["tau_px"], 1);
    EXPECT_EQ(json["rows"][0]["frames"], 6);
    EXPECT_TRUE(json["rows"][0]["max_error_px"].is_null()) << "it was not asked for";
    EXPECT_GT(json["rows"][0]["triangles"]["median"], json["rows"][1]["triangles"]["median"]);
    // The same flight makes the same meshes.
    fs::rename(out_, folder_ / "first");
    const auto again =
        bench(fmt::format("--flight {} --methods soar-bounded --morph off --tau 1 --frames 3 --runs 1",
                          (folder_ / "first" / "flight.txt").string()));
    ASSERT_EQ(again.status, 0) << again.err;
    const auto second = nlohmann::json::parse(contents(out_ / "bench.json"));
    EXPECT_EQ(second["rows"][0]["triangles"]["mean"], json["rows"][0]["triangles"]["mean"]);
}

TEST_F(BenchCommand, RefusesBeforeItBegins) {
    for (const char* flags :
         {"--taus 1,x", "--taus 0", "--methods best", "--methods soar-bounded,", "--frames 0", "--runs 0",
          "--error-every -1", "--budget 0", "--max-triangles 1", "--morph maybe", "--ocean-rows few",
          "--ocean-at 91,0", "--ocean-at 1", "--size 5000x10", "--at 1,2,3", "--lod full"}) {
        const auto run = bench(flags);
        EXPECT_EQ(run.status, 2) << flags << run.err;
        EXPECT_FALSE(run.err.empty()) << flags;
    }
    const auto no_flight = bench("--flight /nonexistent");
    EXPECT_EQ(no_flight.status, 3) << no_flight.err;
    fs::create_directory(out_);
    replace(out_ / "mine", "stays");
    const auto full = bench("--quick");
    EXPECT_EQ(full.status, 2);
    EXPECT_NE(full.err.find("--overwrite"), std::string::npos) << full.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(out_), fs::directory_iterator()), 1);
}

TEST_F(BenchCommand, CtrlCLeavesNothing) {
    const pid_t program = fork();
    if (program == 0) {
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        execl(RELEVO_PROGRAM, "relevo", "bench", scene_.c_str(), "-o", out_.c_str(), "--frames", "10000",
              nullptr);
        _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    kill(program, SIGINT);
    int status = 0;
    ASSERT_EQ(waitpid(program, &status, 0), program);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) != 0);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1)
        << "the scene alone";
}

}  // namespace
}  // namespace relevo::test
