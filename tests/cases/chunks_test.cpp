// The quadtree of nodes on real elevation models: what the nodes say of themselves, every pair of neighbours
// that a picture may put side by side, and measured pictures.

#include <algorithm>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "lod/lstr/chunk_file.hpp"
#include "lod/lstr/chunk_group.hpp"
#include "lod/lstr/chunk_index.hpp"
#include "lod/lstr/chunk_mesher.hpp"
#include "lod/lstr/chunk_set.hpp"
#include "lod/mesh_checks.hpp"
#include "lod/oracle.hpp"
#include "lod/sample_views.hpp"
#include "lod/scene/scene.hpp"
#include "tests/cases/real_dem.hpp"
#include "tests/lod/brute_chunk_error.hpp"
#include "tests/lod/scratch_scene.hpp"
#include "tests/shared_data.hpp"

namespace relevo::lod {
namespace {

using test::RealDem;

const RealDem kDems[] = {
    {"baltoro", "mountains/baltoro.tif", ""},                  // not square, extreme relief
    {"helens", "odd/SainteHelens.dem", ""},                    // warped from UTM, edges full of void
    {"netherlands", "coast/netherlands_30s.nc", "EPSG:4326"},  // flat, sea
    {"columbia", "coast/columbia.tif", ""},                    // glacier, fjord
    {"logan", "mosaic/logan/logan.vrt", ""},                   // mountains beside a plain
};

/// All groups of a terrain's nodes, ready to be drawn.
class AllGroups {
  public:
    AllGroups(const Terrain& terrain, const ChunkSet& chunks)
        : frame_(terrain.frame()), index_(frame_), groups_(terrain, chunks, 1) {
        const auto load = [&](const ChunkId& parent) {
            auto group = groups_.load(parent);
            EXPECT_TRUE(group);
            if (group) loaded_.emplace(parent, *std::move(group));
        };
        load(index_.root().parent());
        index_.for_each(load);
    }

    bool has(const ChunkId& id) const {
        return id.level == 0 ? id.column >= 0 && id.row >= 0 && has_data(id, frame_) : index_.has(id);
    }
    const PlacedChunk& node(const ChunkId& id) const {
        return loaded_.at(id.parent()).children[id.sibling()];
    }
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const auto& [parent, group] : loaded_) {
            for (int i = 0; i < 4; ++i) {
                if (has(parent.child(i))) visit(parent.child(i));
            }
        }
    }

  private:
    geo::GridFrame frame_;
    ChunkIndex index_;
    ChunkGroups groups_;
    std::map<ChunkId, ChunkGroup> loaded_;
};

/// A side's vertices: where they are drawn at rest, and how far they may move.
struct OnSide {
    GridPoint at;
    glm::ivec3 place;
    float rise_m;
    bool kept;
};

std::vector<OnSide> side_of(const PlacedChunk& node, Side side) {
    std::vector<OnSide> found;
    for (const SideVertex& on : node.sides[static_cast<std::size_t>(side)]) {
        const PlacedChunk::Vertex& v = node.vertices[on.vertex];
        found.push_back({{v.column, v.row}, v.at, v.rise_m, on.kept});
    }
    return found;
}

Side opposite(Side side) {
    if (side == Side::west) return Side::east;
    if (side == Side::east) return Side::west;
    return side == Side::north ? Side::south : Side::north;
}

class ChunksOfRealDems : public testing::TestWithParam<RealDem> {};

TEST_P(ChunksOfRealDems, KeepTheirErrorsAndFit) {
    RELEVO_NEEDS_DATA(GetParam().file);
    const test::SceneFolder folder;
    const auto scene = test::import_real(GetParam(), folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto terrain = Terrain::open(*scene, ErrorMetric::bounded, {.fade_s = 0});
    ASSERT_TRUE(terrain) << terrain.error().message;
    const auto chunks = MemoryChunks::build(*terrain, chunk_errors(*terrain));
    ASSERT_TRUE(chunks) << chunks.error().message;

    // No node is farther off than it says.
    int judged = 0;
    ChunkIndex(terrain->frame()).for_each([&](const ChunkId& id) {
        const auto mesh = chunks->mesh(id);
        ASSERT_TRUE(mesh);
        const double worst_m = test::brute_error_m(*terrain, **mesh);
        EXPECT_LE(worst_m, (*mesh)->error_m) << id.level << " " << id.column << " " << id.row;
        judged += worst_m > 0 ? 1 : 0;
    });
    EXPECT_GT(judged, 40);

    // Two neighbours of one level have the same vertices on their side; of two a level apart the finer one
    // has those of the coarser one, and knows it. What is between is closed by triangles that the side's own
    // vertices make, so that no other pair can be in a picture, and none leaves a crack.
    const AllGroups all(*terrain, *chunks);
    int same_level = 0;
    int a_level_apart = 0;
    all.for_each([&](const ChunkId& id) {
        for (const Side side : {Side::west, Side::east, Side::north, Side::south}) {
            const std::vector<OnSide> own = side_of(all.node(id), side);
            const ChunkId across = id.beside(side);
            if (all.has(across)) {
                const std::vector<OnSide> other = side_of(all.node(across), opposite(side));
                ASSERT_TRUE(std::equal(
                    own.begin(), own.end(), other.begin(), other.end(), [](const OnSide& a, const OnSide& b) {
                        return a.at == b.at && a.place == b.place && a.rise_m == b.rise_m && a.kept == b.kept;
                    }));
                ++same_level;
            }
            const ChunkId coarser = across.parent();
            if (coarser == id.parent() || !all.has(coarser)) continue;
            const GridPoint first = own.front().at, last = own.back().at;
            std::vector<OnSide> expected;
            for (const OnSide& v : side_of(all.node(coarser), opposite(side))) {
                if (v.at.column >= first.column && v.at.column <= last.column && v.at.row >= first.row &&
                    v.at.row <= last.row)
                    expected.push_back(v);
            }
            std::vector<OnSide> kept;
            std::copy_if(own.begin(), own.end(), std::back_inserter(kept),
                         [](const OnSide& v) { return v.kept; });
            ASSERT_TRUE(std::equal(kept.begin(), kept.end(), expected.begin(), expected.end(),
                                   [](const OnSide& a, const OnSide& b) {
                                       return a.at == b.at && a.place == b.place && a.rise_m == 0;
                                   }))
                << id.level << " " << id.column << " " << id.row << " " << static_cast<int>(side);
            ++a_level_apart;
        }
    });
    EXPECT_GT(same_level, 300);
    EXPECT_GT(a_level_apart, 150);

    ChunkMesher mesher(*terrain, *chunks);
    double most_of_tau = 0;
    for (const double tau : {0.5, 2.0}) {
        for (const bool morph : {false, true}) {
            double worst_px = 0;
            for (const Camera& camera : sample_views(*terrain, 8, 20261123, 480, 270)) {
                const View view(camera);
                const auto mesh = mesher.whole_mesh(view, {.tau_px = tau, .morph = morph});
                ASSERT_TRUE(mesh);
                EXPECT_EQ(count_t_vertices(**mesh), 0);
                EXPECT_EQ(count_torn_posts(**mesh), 0);
                const auto error = measure_error(*terrain, view, **mesh);
                if (!error) continue;
                EXPECT_EQ(error->uncovered_posts, 0U);
                worst_px = std::max(worst_px, error->max_px);
            }
            EXPECT_LE(worst_px, tau);
            most_of_tau = std::max(most_of_tau, worst_px / tau);
        }
    }
    EXPECT_GT(most_of_tau, 0.05) << "the bound is of use";
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ChunksOfRealDems, testing::ValuesIn(kDems),
                         [](const auto& dem) { return std::string(dem.param.name); });

}  // namespace
}  // namespace relevo::lod
