#include "viewer/ground/node_buffers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "lod/lstr/chunk_mesher.hpp"
#include "lod/sample_views.hpp"
#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

using viewer::DrawSettings;
using viewer::Layer;
using viewer::NodeBuffers;

double hills(int column, int row) {
    return 300 * std::sin(0.05 * column) * std::cos(0.03 * row) + 40 * std::sin(0.31 * column + 0.2 * row) +
           6 * noise(column, row);
}

struct Trial {
    Trial()
        : studio(make_terrain(geographic_frame(513, 400), make_heights(geographic_frame(513, 400), hills))),
          chunks(must(lod::MemoryChunks::build(studio.terrain(), lod::ChunkErrors::for_spacing(25)))),
          mesher(studio.terrain(), chunks) {}

    lod::View over(double column, double metres, double pitch = -30) const {
        auto camera = above_looking_down(studio.terrain(), column, 200, metres, 320, 180);
        camera.pitch.value = pitch;
        return lod::View(camera);
    }

    Studio studio;
    lod::MemoryChunks chunks;
    lod::ChunkMesher mesher;
};

/// Pixels of which a channel differs by more than a step of rounding.
int differing(const viewer::Picture& a, const viewer::Picture& b) {
    int found = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const auto one = a.at(x, y);
            const auto other = b.at(x, y);
            found += std::abs(one[0] - other[0]) > 1 || std::abs(one[1] - other[1]) > 1 ||
                             std::abs(one[2] - other[2]) > 1
                         ? 1
                         : 0;
        }
    }
    return found;
}

// The mesh of which errors are measured is the ground that is drawn: stitched, moving, exaggerated.
TEST(NodeBuffers, DrawTheMeshThatIsMeasured) {
    Trial trial;
    for (const Layer layer : {Layer::plain, Layer::lod, Layer::hillshade}) {
        for (const double exaggeration : {1.0, 2.5}) {
            for (const double tau_px : {1.0, 8.0}) {
                for (const lod::Camera& camera : lod::sample_views(trial.studio.terrain(), 6, 3, 320, 180)) {
                    const lod::View view(camera);
                    const DrawSettings settings{
                        .layer = layer, .exaggeration = exaggeration, .background = kMagenta};
                    const auto picture = must(trial.mesher.whole_picture(
                        view, {.tau_px = tau_px, .morph = true, .exaggeration = exaggeration}));
                    const auto nodes = trial.studio.draw(view, picture, settings);
                    EXPECT_EQ(trial.studio.figures.draw_calls, static_cast<int>(picture.nodes->size()));
                    const lod::Mesh& mesh = trial.mesher.assemble(view, picture);
                    EXPECT_EQ(mesh.triangles(), picture.triangles);
                    EXPECT_EQ(mesh.vertices.size(), picture.vertices);
                    const auto joined = trial.studio.draw(view, mesh, settings);
                    // Places are rounded otherwise, by a ten-millionth of their distance: an edge may take a
                    // pixel more.
                    EXPECT_LE(differing(nodes, joined), 320 * 180 / 500)
                        << to_string(layer) << " " << exaggeration << " " << tau_px;
                }
            }
        }
    }
}

TEST(NodeBuffers, LeaveNoPixelBetweenNodesOpen) {
    Trial trial;
    int moving = 0;
    for (int i = 0; i < 120; ++i) {
        const double metres = 500 + 40 * i;
        const lod::View view = trial.over(256, metres, -90);
        const auto picture = must(trial.mesher.whole_picture(view, {.tau_px = 2, .morph = true}));
        for (const lod::SelectedChunk& node : *picture.nodes)
            moving += node.moved > 0 && node.moved < 1 ? 1 : 0;
        const auto drawn = trial.studio.draw(view, picture, {.layer = Layer::plain, .background = kMagenta});
        for (int y = 0; y < drawn.height; ++y) {
            for (int x = 0; x < drawn.width; ++x) ASSERT_FALSE(is_magenta(drawn.at(x, y))) << metres;
        }
    }
    EXPECT_GT(moving, 100) << "nothing moves: nothing is tested";
}

TEST(NodeBuffers, SendANodeOnceAndKeepABoundedNumber) {
    Trial trial;
    NodeBuffers buffers;
    const auto look = [&](double column) {
        const auto picture =
            must(trial.mesher.whole_picture(trial.over(column, 300), {.tau_px = 1, .morph = true}));
        buffers.upload(picture);
        return buffers.figures();
    };
    const NodeBuffers::Figures first = look(100);
    EXPECT_GT(first.nodes, 10u);
    EXPECT_EQ(first.sent_bytes, first.bytes);
    EXPECT_EQ(look(100).sent_bytes, 0u) << "a view that stays sends nothing";
    const NodeBuffers::Figures near = look(101);
    EXPECT_LT(near.sent_bytes, first.bytes / 4);
    std::uint64_t most_bytes = 0;
    for (int column = 100; column < 400; column += 4) most_bytes = std::max(most_bytes, look(column).bytes);
    EXPECT_GT(most_bytes, first.bytes);
    EXPECT_LT(most_bytes, 4 * first.bytes);
}

TEST(NodeBuffers, AreGoneWhenAMeshIsDrawn) {
    Trial trial;
    const lod::View view = trial.over(100, 300);
    const auto picture = must(trial.mesher.whole_picture(view, {.tau_px = 1}));
    viewer::Renderer& renderer = trial.studio.renderer();
    renderer.upload(picture);
    EXPECT_GT(renderer.node_figures().bytes, 0u);
    renderer.upload(trial.mesher.assemble(view, picture));
    EXPECT_EQ(renderer.node_figures().bytes, 0u);
}

TEST(NodeBuffers, AnEyeFarBeyondTheTerrainSeesIt) {
    Trial trial;
    for (const double metres : {300e3, 3e6}) {  // beyond the whole numbers of places, which end at 64 km
        auto camera = above_looking_down(trial.studio.terrain(), 256, 200, metres, 320, 180);
        camera.fov.value = 2 * std::atan(3000 / metres) * 180 / M_PI;
        const lod::View view(camera);
        const auto picture = must(trial.mesher.whole_picture(view, {.tau_px = 0.5}));
        const DrawSettings settings{.layer = Layer::plain, .background = kMagenta};
        const auto nodes = trial.studio.draw(view, picture, settings);
        const auto joined = trial.studio.draw(view, trial.mesher.assemble(view, picture), settings);
        EXPECT_FALSE(is_magenta(nodes.at(160, 90))) << metres;
        EXPECT_LE(differing(nodes, joined), 320 * 180 / 100) << metres;
    }
}

}  // namespace
}  // namespace relevo::test
