#include "lod/tiles/tile_store.hpp"

#include <algorithm>
#include <bit>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/pyramid/memory_pyramid.hpp"
#include "lod/soar/metrics.hpp"
#include "lod/soar/refiner.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

/// A pyramid in memory of which some blocks cannot be read.
class Ground final : public Pyramid {
  public:
    explicit Ground(int columns, int rows)
        : frame_(test::geographic_frame(columns, rows)),
          memory_(frame_, test::make_heights(frame_, test::mountains),
                  build_metrics(frame_, {}, test::make_heights(frame_, test::mountains))) {}

    const geo::GridFrame& frame() const override { return frame_; }
    Result<VertexPosts> read_vertices(const PyramidBlock& block, ErrorMetric metric) const override {
        if (block == damaged) return Error{ErrorKind::damaged, "level 0, block 1 1: damaged"};
        return memory_.read_vertices(block, metric);
    }
    Result<GroundPosts> read_ground(const PyramidBlock& block) const override {
        return memory_.read_ground(block);
    }

    PyramidBlock damaged{-1, 0, 0};

  private:
    geo::GridFrame frame_;
    MemoryPyramid memory_;
};

std::shared_ptr<Ground> ground() {
    static const auto made = std::make_shared<Ground>(1025, 900);
    made->damaged.level = -1;
    return made;
}

Terrain open(const std::shared_ptr<const Pyramid>& pyramid, const TileStoreOptions& options) {
    auto terrain = Terrain::open(pyramid, {}, ErrorMetric::bounded, options);
    if (!terrain) throw std::runtime_error(terrain.error().message);
    return std::move(*terrain);
}

Camera camera_over(const Terrain& terrain, double column, double row, double metres, double pitch = -15) {
    Camera camera;
    camera.eye = test::above(terrain, column, row, metres);
    camera.pitch = geo::Degrees{pitch};
    camera.width = 320;
    camera.height = 180;
    return camera;
}

/// How far a vertex may have come in: the least of the tiles of its level that it lies in and that hold data;
/// 1 where there are none.
double presence(const TileStore& tiles, const GridPoint& v) {
    const TileGrid& grid = tiles.grid();
    const int level = std::countr_zero(static_cast<unsigned>(v.column | v.row));
    const int posts = grid.cells(level) << level;
    double least = 1;
    for (const int dy : {-1, 0}) {
        for (const int dx : {-1, 0}) {
            if ((dx != 0 && v.column % posts != 0) || (dy != 0 && v.row % posts != 0)) continue;
            const TileId id{level, v.column / posts + dx, v.row / posts + dy};
            if (!grid.contains(id) || !grid.holds_data(id)) continue;
            const auto* tile = tiles.find(id);
            least = std::min(least, tile == nullptr ? 0 : tile->presence);
        }
    }
    return least;
}

/// By brute force over all vertices: none may be further in than its parents, nor than the ends of the edge
/// that it splits.
int count_breaches(const TileStore& tiles) {
    const int levels = tiles.grid().levels;
    int breaches = 0;
    for (int level = 1; level < 2 * levels; ++level) {
        for (int row = 0; row <= 1 << levels; ++row) {
            for_each_vertex_in_row(levels, level, row, [&](const GridPoint& v) {
                const double own = presence(tiles, v);
                // Beyond the data nothing is drawn.
                if (own == 0 || v.column > tiles.grid().last_column || v.row > tiles.grid().last_row) return;
                const Diamond d = diamond(v, level, levels);
                for (const GridPoint& parent : d.apexes) breaches += presence(tiles, parent) < own;
                for (const GridPoint& end : {d.left, d.right}) {
                    const bool is_corner = end.column % (1 << levels) == 0 && end.row % (1 << levels) == 0;
                    breaches += !is_corner && presence(tiles, end) < own;
                }
            });
        }
    }
    return breaches;
}

// Wishes for tiles anywhere, at any level, into a memory that holds a few of them.
TEST(TileStore, IsClosedUnderParentsWhateverIsThere) {
    for (const double fade_s : {0.0, 0.02}) {
        const Terrain terrain = open(ground(), {.memory_bytes = 3 << 20, .threads = 0, .fade_s = fade_s});
        TileStore& tiles = terrain.tiles();
        std::mt19937 random(7);
        std::size_t most = 0;
        for (int step = 0; step < 60; ++step) {
            for (int k = 0; k < 12; ++k) {
                const int level = static_cast<int>(random() % 3);
                const auto across = static_cast<unsigned>(tiles.grid().across(level));
                tiles.want({level, static_cast<int>(random() % across), static_cast<int>(random() % across)},
                           static_cast<double>(random() % 100));
            }
            tiles.start_frame();
            while (random() % 4 != 0 && tiles.wait()) tiles.start_frame();
            tiles.start_frame();
            const auto figures = tiles.figures();
            EXPECT_LE(figures.resident_bytes, std::size_t{3} << 20);
            most = std::max(most, figures.resident_tiles);
            if (step % 10 == 9) {
                EXPECT_EQ(count_breaches(tiles), 0) << step;
            }
        }
        EXPECT_GT(most, 30u);
    }
}

// Each time that something has been read the picture is coarse, but whole; at the end it is as good as asked
// for.
TEST(TileStore, MeshesAreWholeWhateverIsMissing) {
    for (const bool morph : {false, true}) {
        const Terrain terrain = open(ground(), {.threads = 0, .fade_s = 0});
        TileStore& tiles = terrain.tiles();
        Refiner refiner(terrain);
        const View view(camera_over(terrain, 500, 600, 150));
        int partial = 0;
        for (;;) {
            tiles.start_frame();
            const Mesh& mesh = refiner.refine(view, {.tau_px = 1, .morph = morph});
            ASSERT_EQ(count_t_vertices(mesh), 0);
            ASSERT_EQ(count_torn_posts(mesh), 0);
            const auto error = measure_error(terrain, view, mesh);
            ASSERT_TRUE(error);
            ASSERT_EQ(error->uncovered_posts, 0u);
            tiles.start_frame();
            if (tiles.figures().pending_tiles == 0) {
                EXPECT_LE(error->max_px, 1);
                break;
            }
            partial += error->max_px > 1;
            ASSERT_TRUE(tiles.wait());
        }
        EXPECT_GT(partial, 0);  // there was something to be seen of it
    }
}

// A flight at a speed at which nothing arrives in time, through a memory that is too small for a fast one,
// from slow reads.
TEST(TileStore, FlyingTooFastMakesPicturesCoarserNeverCracked) {
    const std::size_t memory = std::size_t{5} << 20;
    const Terrain terrain =
        open(ground(), {.memory_bytes = memory, .threads = 4, .fade_s = 0.05, .read_delay_s = 0.01});
    TileStore& tiles = terrain.tiles();
    Refiner refiner(terrain);
    const RefineOptions options{.tau_px = 1, .morph = true};
    int fading = 0;
    int behind = 0;
    for (int frame = 0; frame < 120; ++frame) {
        const View view(camera_over(terrain, 20 + 8 * frame, 860 - 7 * frame, 120));
        tiles.start_frame();
        fading += tiles.is_fading();
        const Mesh& mesh = refiner.refine(view, options);
        ASSERT_EQ(count_t_vertices(mesh), 0) << frame;
        ASSERT_EQ(count_torn_posts(mesh), 0) << frame;
        EXPECT_LE(tiles.figures().resident_bytes, memory);
        behind += tiles.figures().pending_tiles > 0;
    }
    EXPECT_GT(fading, 0);
    EXPECT_GT(behind, 0);
    const View last(camera_over(terrain, 20 + 8 * 119, 860 - 7 * 119, 120));
    const auto whole = refiner.refine_whole(last, options);
    ASSERT_TRUE(whole) << whole.error().message;
    const auto error = measure_error(terrain, last, **whole);
    ASSERT_TRUE(error);
    EXPECT_LE(error->max_px, 1);
    EXPECT_EQ(error->uncovered_posts, 0u);
}

// What comes in late does not pop: with nothing but time passing, the surface moves by little between frames.
TEST(TileStore, ArrivingTilesFadeIn) {
    const Terrain terrain = open(ground(), {.threads = 0, .fade_s = 0.3});
    TileStore& tiles = terrain.tiles();
    Refiner refiner(terrain);
    const View view(camera_over(terrain, 500, 600, 150));
    double presence_seen = 0;
    while (true) {
        tiles.start_frame();
        refiner.refine(view, {.tau_px = 1, .morph = false});
        tiles.start_frame();
        if (tiles.figures().pending_tiles == 0) break;
        if (!tiles.wait()) break;
    }
    const auto* tile = tiles.find({tiles.grid().root().level, 0, 0});
    ASSERT_NE(tile, nullptr);
    EXPECT_EQ(tile->presence, 1);  // what is there from the start does not fade
    for (int k = 0; k < 5 && tiles.is_fading(); ++k) {
        tiles.start_frame();
        EXPECT_EQ(count_breaches(tiles), 0);
        refiner.refine(view, {.tau_px = 1, .morph = false});
        presence_seen = std::max(presence_seen, 1.0);
    }
    const auto whole = refiner.refine_whole(view, {.tau_px = 1, .morph = false});
    ASSERT_TRUE(whole);
    EXPECT_FALSE(tiles.is_fading());
}

TEST(TileStore, DamagedBlocksAreToldAndDrawnAsTheirParents) {
    const auto pyramid = ground();
    pyramid->damaged = {0, 1, 2};
    const Terrain terrain = open(pyramid, {.threads = 0, .fade_s = 0});
    TileStore& tiles = terrain.tiles();
    Refiner refiner(terrain);
    const View view(camera_over(terrain, 400, 640, 100, -60));
    const auto whole = refiner.refine_whole(view, {.tau_px = 0.5});
    ASSERT_FALSE(whole);
    EXPECT_NE(whole.error().message.find("damaged"), std::string::npos);
    tiles.start_frame();
    const Mesh& mesh = refiner.refine(view, {.tau_px = 0.5});
    EXPECT_EQ(count_t_vertices(mesh), 0);
    EXPECT_GT(mesh.triangles(), 100u);
    tiles.start_frame();
    EXPECT_EQ(tiles.figures().pending_tiles, 0u);  // nobody waits for it
    pyramid->damaged.level = -1;
}

TEST(TileStore, TooLittleMemoryForAViewIsSaid) {
    const Terrain terrain = open(ground(), {.memory_bytes = 1 << 18, .threads = 2, .fade_s = 0});
    Refiner refiner(terrain);
    const auto whole = refiner.refine_whole(View(camera_over(terrain, 500, 600, 30)), {.tau_px = 0.25});
    ASSERT_FALSE(whole);
    EXPECT_NE(whole.error().message.find("--memory"), std::string::npos) << whole.error().message;
    EXPECT_GT(terrain.tiles().figures().memory_load, 1);
}

// Was wrong: with a full memory, tiles of the last frame were let go between two of its looks, and a tile
// that waited for one that waited itself was never complete, without a word: the picture stayed coarse.
TEST(TileStore, WholeMeansWholeInAMemoryThatIsFull) {
    const Terrain ample = open(ground(), {.threads = 0, .fade_s = 0});
    Refiner expected(ample);
    const Terrain tight = open(ground(), {.memory_bytes = 6 << 20, .threads = 2, .fade_s = 0});
    Refiner refiner(tight);
    for (int k = 0; k < 12; ++k) {
        const View view(camera_over(ample, 80 + 70 * k, 850 - 60 * k, k % 2 == 0 ? 60 : 400));
        const auto mesh = refiner.refine_whole(view, {.tau_px = 1, .morph = false});
        ASSERT_TRUE(mesh) << mesh.error().message;
        EXPECT_EQ((*mesh)->triangles(),
                  (**expected.refine_whole(view, {.tau_px = 1, .morph = false})).triangles());
        // Of the same tiles, by the same measure.
        const double memory_ratio = 256.0 / 6;
        EXPECT_NEAR(tight.tiles().figures().memory_load, memory_ratio * ample.tiles().figures().memory_load,
                    0.02);
    }
}

// Was wrong: a tile that came between a frame and the look at what it had missed counted as not missed.
TEST(TileStore, WhatAFrameMissedItMissed) {
    const Terrain terrain = open(ground(), {.threads = 0, .fade_s = 0});
    TileStore& tiles = terrain.tiles();
    const TileId id{1, 2, 2};
    tiles.want(id, 1);
    tiles.start_frame();
    ASSERT_TRUE(tiles.wait());  // it has been read
    tiles.want(id, 1);          // and a frame is drawn without it
    tiles.start_frame();
    EXPECT_NE(tiles.find(id), nullptr);
    EXPECT_GT(tiles.figures().pending_tiles, 0u);
    tiles.start_frame();
    EXPECT_EQ(tiles.figures().pending_tiles, 0u);
}

// One core or all: the same triangles.
TEST(TileStore, AllCoresMakeTheMeshOfOne) {
    const Terrain terrain = open(ground(), {.threads = 0, .fade_s = 0});
    Refiner refiner(terrain);
    const auto triangles = [&](const View& view, bool parallel) {
        const Mesh& mesh = **refiner.refine_whole(view, {.tau_px = 0.5, .morph = true, .parallel = parallel});
        std::vector<std::array<std::uint32_t, 9>> all;
        for (std::size_t t = 0; t < mesh.triangles(); ++t) {
            std::array<std::uint32_t, 9> corners{};
            for (std::size_t k = 0; k < 3; ++k) {
                const MeshVertex& v = mesh.vertices[mesh.indices[3 * t + k]];
                corners[3 * k] = static_cast<std::uint32_t>(v.row) << 16 | v.column;
                corners[3 * k + 1] = std::bit_cast<std::uint32_t>(v.x);
                corners[3 * k + 2] = std::bit_cast<std::uint32_t>(v.z);
            }
            all.push_back(corners);
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    for (const double metres : {30.0, 3000.0}) {
        const View view(camera_over(terrain, 500, 600, metres));
        const auto alone = triangles(view, false);
        EXPECT_GT(alone.size(), 1000u);
        EXPECT_EQ(alone, triangles(view, true));
    }
}

}  // namespace
}  // namespace relevo::lod
