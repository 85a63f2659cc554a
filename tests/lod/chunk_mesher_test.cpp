#include "lod/lstr/chunk_mesher.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/sample_views.hpp"
#include "lod/static_mesh/grid_triangle.hpp"
#include "lod/surface_jump.hpp"
#include "tests/lod/brute_chunk_error.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

double hills(int column, int row) {
    return 300 * std::sin(0.05 * column) * std::cos(0.03 * row) + 40 * std::sin(0.31 * column + 0.2 * row) +
           6 * test::noise(column, row);
}

struct Trial {
    explicit Trial(int columns, int rows, double (*height)(int, int) = hills)
        : terrain(test::make_terrain(test::geographic_frame(columns, rows),
                                     test::make_heights(test::geographic_frame(columns, rows), height))),
          chunks(*MemoryChunks::build(terrain, ChunkErrors::for_spacing(25))) {}

    Terrain terrain;
    MemoryChunks chunks;
};

TEST(Chunks, StayWithinTheirErrors) {
    const Trial trial(513, 400);
    const ChunkErrors errors = ChunkErrors::for_spacing(25);
    for (int level = 1; level <= 4; ++level) {
        double worst = 0;
        for (int row = 0; row < 16 >> level; ++row) {
            for (int column = 0; column < 16 >> level; ++column) {
                if (const ChunkNode* node = trial.chunks.node({level, column, row}))
                    worst = std::max(worst, node->error_m);
            }
        }
        EXPECT_GT(worst, 0.3 * errors.of_level(level)) << level;
        // Between rough posts along a side of level 1 there is no better mesh (docs/lstr.md).
        EXPECT_LE(worst, (level == 1 ? 2 : 1.05) * errors.of_level(level)) << level;
    }
}

TEST(Chunks, ErrorsAreThoseOfAllPosts) {
    // By brute force: no post is farther from the triangle that it is in than the node says.
    const Trial trial(257, 200);
    for (int level = 1; level <= 3; ++level) {
        for (int row = 0; row < 8 >> level; ++row) {
            for (int column = 0; column < 8 >> level; ++column) {
                const ChunkId id{level, column, row};
                if (trial.chunks.node(id) == nullptr) continue;
                const auto mesh = trial.chunks.mesh(id);
                ASSERT_TRUE(mesh);
                const double worst_m = test::brute_error_m(trial.terrain, **mesh);
                EXPECT_GE(worst_m, 0);
                EXPECT_LE(worst_m, (*mesh)->error_m) << level << " " << column << " " << row;
            }
        }
    }
}

TEST(Chunks, OfOneLevelMakeOneMesh) {
    const Trial trial(513, 513);
    for (int level = 1; level <= 4; ++level) {
        // Every inner edge of the joint mesh belongs to two triangles.
        using Edge = std::pair<std::pair<int, int>, std::pair<int, int>>;
        std::map<Edge, int> edges;
        const int nodes = 16 >> level;
        for (int row = 0; row < nodes; ++row) {
            for (int column = 0; column < nodes; ++column) {
                const auto mesh = trial.chunks.mesh({level, column, row});
                ASSERT_TRUE(mesh);
                for (const IndexTriangle& t : (*mesh)->triangles) {
                    for (std::size_t i = 0; i < 3; ++i) {
                        const GridPoint& a = (*mesh)->vertices[t[i]].at;
                        const GridPoint& b = (*mesh)->vertices[t[(i + 1) % 3]].at;
                        std::pair from{a.row, a.column}, to{b.row, b.column};
                        if (to < from) std::swap(from, to);
                        ++edges[{from, to}];
                    }
                }
            }
        }
        for (const auto& [edge, count] : edges) {
            const auto& [a, b] = edge;
            const bool outer =
                (a.first == b.first && a.first % 512 == 0) || (a.second == b.second && a.second % 512 == 0);
            ASSERT_EQ(count, outer ? 1 : 2) << level;
        }
    }
}

/// Triangles without an area on the map: pictures lose pixels in them.
int count_slivers(const Mesh& mesh) {
    int count = 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto post = [&](std::size_t corner) {
            const MeshVertex& v = mesh.vertices[mesh.indices[3 * t + corner]];
            return GridPoint{v.column, v.row};
        };
        count += turn(post(0), post(1), post(2)) <= 0 ? 1 : 0;
    }
    return count;
}

TEST(ChunkMesher, KeepsTheErrorAndLeavesNoCrack) {
    const Trial trial(513, 400);
    ChunkMesher mesher(trial.terrain, trial.chunks);
    for (const bool morph : {false, true}) {
        for (const double tau : {0.7, 2.0}) {
            for (const Camera& camera : sample_views(trial.terrain, 30, 3, 320, 180)) {
                const View view(camera);
                const auto mesh = mesher.whole_mesh(view, {.tau_px = tau, .morph = morph});
                ASSERT_TRUE(mesh);
                EXPECT_EQ(count_t_vertices(**mesh), 0);
                EXPECT_EQ(count_torn_posts(**mesh), 0);
                const auto error = measure_error(trial.terrain, view, **mesh);
                if (error) {
                    EXPECT_LE(error->max_px, tau) << morph << " " << camera.eye.h.m;
                    EXPECT_EQ(error->uncovered_posts, 0U);
                }
                const auto all = mesher.whole_mesh(view, {.tau_px = tau, .morph = morph, .cull = false});
                ASSERT_TRUE(all);
                EXPECT_EQ(count_open_edges(**all, 513, 400), 0);
                EXPECT_EQ(count_slivers(**all), 0);
            }
        }
    }
}

/// The largest jump of a descent in small steps.
double largest_jump_px(const Trial& trial, bool morph, double tau_px) {
    const geo::GridFrame& frame = trial.terrain.frame();
    const geo::LatLon at = frame.lat_lon({0.4 * frame.columns, 0.6 * frame.rows});
    ChunkMesher mesher(trial.terrain, trial.chunks);
    std::optional<View> before;
    Mesh mesh_before;
    double worst_px = 0;
    for (int i = 0; i < 400; ++i) {
        Camera camera;
        camera.eye = {at.lat, at.lon, {8000 - 19.0 * i}};
        camera.pitch = geo::Degrees{-40};
        camera.width = 320;
        camera.height = 180;
        const View view(camera);
        const auto mesh = mesher.whole_mesh(view, {.tau_px = tau_px, .morph = morph});
        if (!mesh) ADD_FAILURE();
        if (before) {
            const auto jump =
                surface_jump(mesh_before, before->eye(), **mesh, view, frame.columns, frame.rows);
            if (jump) worst_px = std::max(worst_px, jump->max_px);
        }
        before = view;
        mesh_before = **mesh;
    }
    return worst_px;
}

TEST(ChunkMesher, MorphsWithoutJumps) {
    const Trial trial(513, 513);
    constexpr double kTau = 2;
    const double with_px = largest_jump_px(trial, true, kTau);
    const double without_px = largest_jump_px(trial, false, kTau);
    // What is left: a finer mesh whose vertices lie on the coarser one has edges across the coarser one's.
    EXPECT_LT(with_px, 0.3 * kTau);
    EXPECT_LT(with_px, 0.8 * without_px);
}

TEST(ChunkMesher, DrawsTheRootAloneWhereThatIsGoodEnough) {
    const Trial trial(513, 400);
    ChunkMesher mesher(trial.terrain, trial.chunks);
    const geo::GridFrame& frame = trial.terrain.frame();
    const geo::LatLon middle = frame.lat_lon({0.5 * frame.columns, 0.5 * frame.rows});
    Camera camera;
    camera.eye = {middle.lat, middle.lon, {3000.0}};
    camera.pitch = geo::Degrees{-90};
    ASSERT_TRUE(mesher.whole_mesh(View(camera), {.tau_px = 200, .morph = false}));
    EXPECT_EQ(mesher.figures().drawn_nodes, 1);
}

TEST(ChunkMesher, DrawsTerrainsOfALeafAndLess) {
    for (const int side : {2, 3, 5, 20, 33, 34, 65}) {
        const Trial trial(side, side);
        ChunkMesher mesher(trial.terrain, trial.chunks);
        for (const Camera& camera : sample_views(trial.terrain, 5, 3, 320, 180)) {
            const View view(camera);
            const auto mesh = mesher.whole_mesh(view, {.tau_px = 1, .morph = false});
            ASSERT_TRUE(mesh);
            const auto error = measure_error(trial.terrain, view, **mesh);
            if (!error) continue;
            EXPECT_LE(error->max_px, 1) << side;
        }
    }
}

TEST(ChunkMesher, LeavesNoCrackWhereReadsAreSlowAndRoomIsShort) {
    const Trial trial(513, 400);
    const geo::GridFrame& frame = trial.terrain.frame();
    for (const double swap_radius_m : {std::numeric_limits<double>::infinity(), 1500.0}) {
        ChunkOptions options;
        options.store = {.memory_bytes = 600 << 10, .threads = 1, .read_delay_s = 0.002};
        options.selection.swap_radius_m = swap_radius_m;
        options.selection.fade_s = 0.02;
        ChunkMesher mesher(trial.terrain, trial.chunks, options);
        std::set<std::size_t> sizes;
        for (int i = 0; i < 300; ++i) {
            const double part = i / 300.0;
            const geo::LatLon at = frame.lat_lon({(0.1 + 0.8 * part) * frame.columns, 0.5 * frame.rows});
            Camera camera;
            camera.eye = {at.lat, at.lon, {700.0}};
            camera.heading = geo::Degrees{360.0 * 3 * part};
            camera.pitch = geo::Degrees{-15};
            camera.width = 320;
            camera.height = 180;
            const auto mesh = mesher.mesh(View(camera), {.tau_px = 0.7, .morph = true});
            ASSERT_TRUE(mesh);
            ASSERT_EQ(count_t_vertices(**mesh), 0) << i;
            ASSERT_EQ(count_torn_posts(**mesh), 0) << i;
            ASSERT_EQ(count_slivers(**mesh), 0) << i;
            ASSERT_LE(mesher.figures().store.resident_bytes, (600U << 10) + (200U << 10)) << i;
            sizes.insert((*mesh)->triangles());
        }
        EXPECT_GT(mesher.figures().store.read_groups, 5U);
        EXPECT_GT(sizes.size(), 10U);
    }
}

TEST(ChunkMesher, ComesToTheWholeMeshOfAViewThatStays) {
    const Trial trial(513, 400);
    ChunkOptions options;
    options.selection.fade_s = 0.01;
    ChunkMesher paged(trial.terrain, trial.chunks, options);
    ChunkMesher whole(trial.terrain, trial.chunks);
    for (const Camera& camera : sample_views(trial.terrain, 5, 9, 320, 180)) {
        const View view(camera);
        const RefineOptions refine{.tau_px = 1, .morph = true};
        std::size_t triangles = 0;
        for (int i = 0; i < 2000; ++i) {
            triangles = (*paged.mesh(view, refine))->triangles();
            if (i > 20 && paged.figures().store.pending_groups == 0 && !paged.figures().fading) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        triangles = (*paged.mesh(view, refine))->triangles();
        EXPECT_EQ(triangles, (*whole.whole_mesh(view, refine))->triangles());
    }
}

}  // namespace
}  // namespace relevo::lod
