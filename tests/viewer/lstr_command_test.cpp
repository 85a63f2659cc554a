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

}  // namespace
}  // namespace relevo::test
