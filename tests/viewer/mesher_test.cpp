#include "viewer/mesher.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/pyramid/memory_pyramid.hpp"
#include "lod/soar/metrics.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::viewer {
namespace {

/// Of 1025 x 900 posts, with so much memory for its tiles.
lod::Terrain mountains(std::size_t memory_bytes) {
    const geo::GridFrame frame = test::geographic_frame(1025, 900);
    const auto heights = test::make_heights(frame, test::mountains);
    auto pyramid =
        std::make_shared<lod::MemoryPyramid>(frame, heights, lod::build_metrics(frame, {}, heights));
    auto terrain = lod::Terrain::open(pyramid, {}, lod::ErrorMetric::bounded,
                                      {.memory_bytes = memory_bytes, .threads = 0, .fade_s = 0});
    if (!terrain) throw std::runtime_error(terrain.error().message);
    return *std::move(terrain);
}

// Was wrong: tiles without room were asked for frame after frame, and the picture never was whole.
TEST(Mesher, TauGrowsUntilTheTerrainFitsInItsMemory) {
    const lod::Terrain terrain = mountains(std::size_t{3} << 20);
    lod::Camera camera;
    camera.eye = test::above(terrain, 500, 600, 100);
    camera.pitch = geo::Degrees{-15};
    camera.width = 640;
    camera.height = 360;
    const lod::View view(camera);
    Mesher mesher(terrain);
    FrameBudget budget({}, 0.25);
    lod::TileStore& tiles = terrain.tiles();
    const lod::Mesh* mesh = nullptr;
    for (int frame = 0; frame < 150; ++frame) {
        mesh = &mesher.mesh(view, mesher.ground(view, {}, budget));
        EXPECT_EQ(lod::count_t_vertices(*mesh), 0) << frame;
        tiles.start_frame();  // takes stock of the frame
        while (tiles.wait()) {
        }
        budget.add({1, mesh->triangles(), tiles.figures().memory_load});
    }
    EXPECT_EQ(tiles.figures().pending_tiles, 0u);
    EXPECT_LE(tiles.figures().memory_load, 1);
    EXPECT_GE(tiles.figures().memory_load, 0.7) << "too careful";
    EXPECT_TRUE(budget.at_rest());
    EXPECT_GT(budget.tau_px(), 0.3);
    const auto error = lod::measure_error(terrain, view, *mesh);
    ASSERT_TRUE(error);
    EXPECT_LE(error->max_px, budget.tau_px());
}

}  // namespace
}  // namespace relevo::viewer
