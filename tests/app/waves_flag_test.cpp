// --waves as people get it wrong. What rasters it takes is tried in tests/ingest.

#include <fstream>

#include <gtest/gtest.h>

#include "tests/app/run_program.hpp"
#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

class WavesFlag : public testing::Test {
  protected:
    WavesFlag() {
        if (relevo("render --help").status != 0) return;  // built without the viewer
        built_ = true;
        std::ofstream grey(folder_ / "grey.pgm", std::ios::binary);
        grey << "P5\n4 4\n255\n";
        for (char i = 0; i < 16; ++i) grey << i;
    }
    void SetUp() override {
        if (!built_) GTEST_SKIP();
    }

    /// Before any scene is opened: there is none.
    test::Run render(const std::string& waves) const {
        return relevo(fmt::format("render '{0}/none.relevo' -o '{0}/a.png' --waves '{1}'",
                                  folder_.path().string(), waves));
    }
    void expect(int status, const std::string& waves, const std::vector<std::string>& words) const {
        const auto run = render(waves);
        EXPECT_EQ(run.status, status) << waves << ": " << run.err;
        EXPECT_EQ(run.out, "");
        for (const auto& word : words) EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    }
    std::string grey() const { return (folder_ / "grey.pgm").string(); }

    SceneFolder folder_;
    bool built_ = false;
};

TEST_F(WavesFlag, NumbersOutOfRangeAreUsageErrors) {
    expect(2, grey() + ",0.5,1", {"--waves", "tile of 0.5 m", "1 to 100000"});
    expect(2, grey() + ",-200,1", {"--waves", "tile of -200 m"});
    expect(2, grey() + ",200,0", {"--waves", "0 m from the lowest", "at most 100"});
    expect(2, grey() + ",200,1e3", {"--waves", "1000 m from the lowest"});
    expect(2, ",200,1", {"--waves", "MAP,TILE_M,HEIGHT_M"});
    expect(2, "", {"--waves"});
}

TEST_F(WavesFlag, FilesThatAreNoMapsAreNamed) {
    expect(3, "none.png", {"--waves: none.png", "no such file", "Check the path"});
    expect(3, grey() + ",x", {"grey.pgm,x", "no such file"});
    expect(3, grey() + ",1,2,3", {"grey.pgm,1", "no such file"});
    expect(3, grey(), {"--waves: grey.pgm", "shades of grey", "HEIGHT_M"});
    expect(3, grey() + ",100", {"shades of grey"});
}

TEST_F(WavesFlag, AMapThatIsGoodLeavesTheSceneToBeMissed) {
    const auto run = render(grey() + ",100,2.5");
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_EQ(run.err.find("grey"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("none.relevo"), std::string::npos) << run.err;
}

TEST_F(WavesFlag, CommasInAFilesNameAreItsOwn) {
    std::filesystem::copy_file(grey(), folder_ / "a,b.pgm");
    expect(3, (folder_ / "a,b.pgm").string(), {"a,b.pgm", "shades of grey"});
}

TEST_F(WavesFlag, ResamplingIsSaid) {
    std::ofstream(folder_ / "odd.pgm", std::ios::binary) << "P5\n3 2\n255\nabcdef";
    const auto run = render((folder_ / "odd.pgm").string() + ",100,2.5");
    EXPECT_NE(run.err.find("3 x 2 posts are resampled to 4 x 4"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace relevo::test
