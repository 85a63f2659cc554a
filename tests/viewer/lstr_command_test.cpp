#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/run_program.hpp"
#include "tests/viewer/scene_for_pictures.hpp"

namespace relevo::test {
namespace {

namespace fs = std::filesystem;

class LstrCommand : public testing::Test {
  protected:
    LstrCommand() : scene_((folder_ / "mountains.relevo").string()), chunks_(scene_ + "/chunks.bin") {
        write_mountains(scene_);
    }

    auto render(const std::string& flags) const {
        return relevo("render " + scene_ + " -o " + (folder_ / "a.png").string() +
                      " --size 160x90 --lod lstr " + flags);
    }

    SceneFolder folder_;
    std::string scene_;
    std::string chunks_;
};

TEST_F(LstrCommand, KeepsToTauAndMakesItsFileOnce) {
    EXPECT_FALSE(fs::exists(chunks_));
    for (const char* tau : {"0.5", "1", "4"}) {
        for (const char* morph : {"on", "off"}) {
            const auto run = render(std::string("--json --measure-error --tau ") + tau + " --morph " + morph);
            ASSERT_EQ(run.status, 0) << run.err;
            const auto json = nlohmann::json::parse(run.out);
            EXPECT_EQ(json["lod"], "lstr");
            EXPECT_GT(json["triangles"], 10);
            EXPECT_LE(json["max_error_px"].get<double>(), std::stod(tau));
            EXPECT_EQ(json["uncovered_posts"], 0);
        }
    }
    ASSERT_TRUE(fs::exists(chunks_));
    const auto made = fs::last_write_time(chunks_);
    ASSERT_EQ(render("").status, 0);
    EXPECT_EQ(fs::last_write_time(chunks_), made);
    EXPECT_EQ(relevo("check " + scene_).status, 0);
}

TEST_F(LstrCommand, TheSameSceneGivesTheSameFile) {
    const auto contents = [&] {
        std::ifstream file(chunks_, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    ASSERT_EQ(render("").status, 0);
    const std::string first = contents();
    fs::remove(chunks_);
    ASSERT_EQ(render("").status, 0);
    EXPECT_TRUE(contents() == first);
}

TEST_F(LstrCommand, AMarginIsOfMetresOfTheRangeOrOfTheScreen) {
    const auto margin_m = [&](const std::string& flags) {
        const auto run = relevo("chunks make " + scene_ + " --json " + flags);
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out)["margin_m"].get<double>();
    };
    const double usual_m = margin_m("");
    const auto usual_bytes = fs::file_size(chunks_);
    EXPECT_EQ(margin_m("--margin screen --filter pairs"), usual_m);
    EXPECT_EQ(fs::file_size(chunks_), usual_bytes);
    const double of_range_m = margin_m("--margin 0.1%");
    EXPECT_NEAR(margin_m("--margin 10%"), 100 * of_range_m, 1e-6 * of_range_m);
    EXPECT_EQ(margin_m("--margin 7.5m --filter mean"), 7.5);
    // A file of another margin does as well: it is not made anew, and the picture keeps to tau.
    const auto made = fs::last_write_time(chunks_);
    const auto run = render("--json --measure-error --tau 1");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_LE(nlohmann::json::parse(run.out)["max_error_px"].get<double>(), 1);
    EXPECT_EQ(fs::last_write_time(chunks_), made);
    for (const char* wrong : {"1e300m", "1e-300m", "2", "m", "-1m", "0m", "nan%", "2m3", "2 m"})
        EXPECT_EQ(relevo("chunks make " + scene_ + " --margin '" + wrong + "'").status, 2) << wrong;
    EXPECT_EQ(relevo("chunks make " + scene_ + " --filter half").status, 2);
}

TEST_F(LstrCommand, ADamagedFileIsSaid) {
    ASSERT_EQ(render("").status, 0);
    const auto size = fs::file_size(chunks_);
    // In the first node, in the table, and at the end.
    for (const auto at : {std::uintmax_t{200}, size - 40}) {
        std::fstream file(chunks_, std::ios::binary | std::ios::in | std::ios::out);
        file.seekg(static_cast<std::streamoff>(at));
        const char byte = static_cast<char>(file.get());
        file.seekp(static_cast<std::streamoff>(at));
        file.put(static_cast<char>(byte ^ 1));
        file.close();
        const auto run = render("--tau 0.05");
        EXPECT_EQ(run.status, 4) << at << run.err;
        EXPECT_NE(run.err.find("chunks.bin"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("delete"), std::string::npos) << run.err;
        fs::remove(chunks_);
        ASSERT_EQ(render("").status, 0);
    }
    fs::resize_file(chunks_, size / 2);
    EXPECT_EQ(render("").status, 4);
}

TEST_F(LstrCommand, AnotherScenesFileIsMadeAnew) {
    ASSERT_EQ(render("").status, 0);
    std::fstream file(chunks_, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(20);  // in the sum of its scene.json
    file.put('x');
    file.close();
    EXPECT_EQ(render("").status, 0);
}

TEST_F(LstrCommand, ANodeIsReplacedAndItsSidesMustFit) {
    const std::string mesh = (folder_ / "node.obj").string();
    ASSERT_EQ(relevo("chunks make " + scene_).status, 0);
    ASSERT_EQ(relevo("chunks extract " + scene_ + " 2/0/0 " + mesh).status, 0);
    const auto text = [&] {
        std::ifstream file(mesh);
        return std::string(std::istreambuf_iterator<char>(file), {});
    }();
    const auto replaced_by = [&](const std::string& changed) {
        std::ofstream(mesh) << changed;
        return relevo("chunks replace " + scene_ + " 2/0/0 " + mesh + " --json");
    };
    const auto same = replaced_by(text);
    ASSERT_EQ(same.status, 0) << same.err;
    EXPECT_GT(nlohmann::json::parse(same.out)["max_error_m"], 0);

    // The first vertex is the node's corner: its neighbours have it where it was.
    const auto first = text.find("\nv ") + 1;
    const auto line_end = text.find('\n', first);
    const std::string lifted = text.substr(0, first) + "v 0 0 9000" + text.substr(line_end);
    const auto refused = replaced_by(lifted);
    EXPECT_EQ(refused.status, 3);
    EXPECT_NE(refused.err.find("side"), std::string::npos) << refused.err;

    const auto holed = replaced_by(text.substr(0, text.rfind("f ")));
    EXPECT_EQ(holed.status, 3);
    EXPECT_NE(holed.err.find("cover"), std::string::npos) << holed.err;
    EXPECT_EQ(replaced_by("v 0 0 x\n").status, 3);
    EXPECT_EQ(relevo("chunks replace " + scene_ + " 2/0/0 " + scene_).status, 3);

    // A tower inside is fine, its error is told, and the picture keeps to tau.
    std::string tower = text;
    for (std::size_t at = tower.find("\nv "); at != std::string::npos; at = tower.find("\nv ", at + 1)) {
        int column = 0, row = 0;
        float H = 0;
        ASSERT_EQ(std::sscanf(tower.c_str() + at + 1, "v %d %d %f", &column, &row, &H), 3);
        if (column % 128 == 0 || row % 128 == 0) continue;
        const auto end = tower.find('\n', at + 1);
        tower.replace(at + 1, end - at - 1,
                      "v " + std::to_string(column) + " " + std::to_string(row) + " 9000");
        break;
    }
    const auto raised = replaced_by(tower);
    ASSERT_EQ(raised.status, 0) << raised.err;
    EXPECT_GT(nlohmann::json::parse(raised.out)["max_error_m"], 1000);
    EXPECT_EQ(relevo("check --files-only " + scene_).status, 0);
    const auto run = render("--json --measure-error --tau 2");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_LE(nlohmann::json::parse(run.out)["max_error_px"].get<double>(), 2);
}

TEST_F(LstrCommand, CheckReadsEveryNode) {
    ASSERT_EQ(relevo("chunks make " + scene_).status, 0);
    EXPECT_EQ(relevo("check --files-only " + scene_).status, 0);
    std::fstream file(chunks_, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(fs::file_size(chunks_) - 5));
    file.put(0x55);
    file.close();
    const auto run = relevo("check --files-only " + scene_);
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_NE(run.err.find("chunks.bin"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace relevo::test
