#include "lod/lstr/chunk_making.hpp"

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "lod/lstr/chunk_file.hpp"
#include "tests/lod/brute_chunk_error.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

/// A scene in which there are several subtrees that a stopped building is gone on with, and some without
/// data.
class ChunkMaking : public testing::Test {
  protected:
    ChunkMaking() {
        test::SceneParts parts = test::made_up_scene(280, 200);
        for (int row = 0; row < 200; ++row) {
            for (int column = 0; column < 280; ++column) {
                parts.heights.at(column, row) =
                    static_cast<float>(300 * std::sin(0.05 * column) * std::cos(0.03 * row) +
                                       40 * std::sin(0.31 * column + 0.2 * row) + test::noise(column, row));
            }
        }
        parts.info.void_posts = 0;
        parts.info.valid_posts = 280 * 200;
        parts.info.resampling.posts = parts.info.valid_posts;
        parts.metrics = build_metrics(parts.info.frame, parts.undulations(), parts.heights);
        EXPECT_TRUE(test::write_scene(parts, folder_ / "scene"));
        scene_.emplace(*Scene::open(folder_ / "scene"));
        terrain_.emplace(*Terrain::open(*scene_, ErrorMetric::bounded, {}));
        // Subtrees are of 128 posts a side here, not of 2048.
        building_ = {chunk_errors(*terrain_), RemovalTest::pairs, 1};
    }

    /// Nodes that were put until it was stopped, before the one after so many, or done.
    int make(int most) {
        int put = 0;
        is_done_ = bool(make_chunk_file(*scene_, *terrain_, building_, [&](double) {
            if (put == most) return false;
            ++put;
            return true;
        }));
        return put;
    }

    std::string file() const { return test::contents(folder_ / "scene" / ChunkFile::kName); }
    void remove_file() const { std::filesystem::remove(folder_ / "scene" / ChunkFile::kName); }

    static constexpr int kNever = 1000000;
    test::SceneFolder folder_;
    std::optional<Scene> scene_;
    std::optional<Terrain> terrain_;
    ChunkBuilding building_;
    bool is_done_ = false;
};

TEST_F(ChunkMaking, StoppedAnywhereGoesOnToTheSameBytes) {
    const int nodes = make(kNever);
    ASSERT_TRUE(is_done_);
    ASSERT_GT(nodes, 25);
    const std::string whole = file();
    for (const int stop : {6, 13, nodes - 1}) {
        remove_file();
        EXPECT_EQ(make(stop), stop);
        EXPECT_FALSE(is_done_);
        EXPECT_TRUE(file().empty());
        const int rest = make(kNever);
        ASSERT_TRUE(is_done_) << stop;
        EXPECT_TRUE(file() == whole) << stop;
        // What is lost is less than a subtree and what is above it.
        EXPECT_LE(rest, nodes - stop + 8) << stop;
    }
}

TEST_F(ChunkMaking, StoppedAgainAndAgainComesToAnEnd) {
    make(kNever);
    const std::string whole = file();
    remove_file();
    int runs = 0;
    for (is_done_ = false; !is_done_ && runs < 100; ++runs) make(7);
    EXPECT_GT(runs, 3);
    EXPECT_TRUE(file() == whole);
}

TEST_F(ChunkMaking, OfAnotherMarginOrFilterBeginsAnew) {
    const int nodes = make(kNever);
    const std::string usual = file();
    building_.errors.first_m *= 3;
    make(20);
    // The file of before stays until then.
    EXPECT_TRUE(file() == usual);
    EXPECT_TRUE(ChunkFile::is_there(*scene_));
    building_.filter = RemovalTest::mean;
    EXPECT_EQ(make(kNever), nodes);
    EXPECT_LT(file().size(), usual.size());
    const auto made = ChunkFile::open(*scene_, *terrain_);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->errors().first_m, building_.errors.first_m);
}

TEST_F(ChunkMaking, OfAWideMarginSaysWhatVerticesMovedInStepsOfItAreOff) {
    building_.errors.first_m = 1000;
    make(kNever);
    const auto made = ChunkFile::open(*scene_, *terrain_);
    ASSERT_TRUE(made);
    int nodes = 0;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 5; ++column) {
            const auto mesh = made->mesh({1, column, row});
            if (!mesh || !*mesh) continue;
            ChunkMesh moved = **mesh;
            for (ChunkVertex& v : moved.vertices) v.H = v.coarse_H;
            EXPECT_LE(test::brute_error_m(*terrain_, moved), (*mesh)->moved_error_m) << column << ' ' << row;
            ++nodes;
        }
    }
    EXPECT_GT(nodes, 10);
}

}  // namespace
}  // namespace relevo::lod
