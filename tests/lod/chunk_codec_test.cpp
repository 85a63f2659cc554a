#include "lod/lstr/chunk_codec.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "lod/lstr/chunk_set.hpp"
#include "tests/lod/synthetic_terrain.hpp"

namespace relevo::lod {
namespace {

class ChunkCodec : public testing::Test {
  protected:
    ChunkCodec() {
        const auto frame = test::geographic_frame(129, 129);
        const auto heights = test::make_heights(
            frame, [](int column, int row) { return 50 * test::noise(column / 3, row / 3) - 20; });
        const Terrain terrain = test::make_terrain(frame, heights);
        const auto chunks = MemoryChunks::build(terrain, ChunkErrors{kFirst});
        mesh_ = **chunks->mesh({1, 1, 0});
    }

    static constexpr double kFirst = 4;
    ChunkMesh mesh_;
};

TEST_F(ChunkCodec, GivesBackWhatItTook) {
    const auto bytes = encode_chunk(mesh_, kFirst);
    auto back = decode_chunk(bytes, mesh_.id, kFirst, "trial");
    ASSERT_TRUE(back);
    ASSERT_EQ(back->vertices.size(), mesh_.vertices.size());
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
        EXPECT_EQ(back->vertices[i].at, mesh_.vertices[i].at);
        EXPECT_EQ(back->vertices[i].H, mesh_.vertices[i].H);
        EXPECT_NEAR(back->vertices[i].coarse_H, mesh_.vertices[i].coarse_H, kFirst / 1000);
    }
    // Another corner may be the first.
    ASSERT_EQ(back->triangles.size(), mesh_.triangles.size());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
        const auto first =
            std::find(back->triangles[i].begin(), back->triangles[i].end(), mesh_.triangles[i].front());
        std::rotate(back->triangles[i].begin(), first, back->triangles[i].end());
    }
    EXPECT_EQ(back->triangles, mesh_.triangles);
    for (std::size_t side = 0; side < kSides; ++side) {
        ASSERT_EQ(back->sides[side].size(), mesh_.sides[side].size());
        for (std::size_t i = 0; i < mesh_.sides[side].size(); ++i) {
            EXPECT_EQ(back->sides[side][i].vertex, mesh_.sides[side][i].vertex);
            EXPECT_EQ(back->sides[side][i].kept, mesh_.sides[side][i].kept);
        }
    }
    EXPECT_EQ(encode_chunk(mesh_, kFirst), bytes);
}

TEST_F(ChunkCodec, SaysHowFarItPutsMovedVerticesOff) {
    for (const double allowed_m : {0.1, kFirst, 1000.0}) {
        const auto back = decode_chunk(encode_chunk(mesh_, allowed_m), mesh_.id, allowed_m, "trial");
        ASSERT_TRUE(back);
        double most = 0;
        for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
            const auto moved = [i](const ChunkMesh& mesh) { return double{mesh.vertices[i].coarse_H}; };
            most = std::max(most, std::abs(moved(*back) - moved(mesh_)));
        }
        EXPECT_EQ(rise_rounding_m(mesh_, allowed_m), most);
        EXPECT_GT(most, 0);
        EXPECT_LE(most, allowed_m / 1000);
        EXPECT_EQ(rise_rounding_m(*back, allowed_m), 0);
    }
}

TEST_F(ChunkCodec, HeightsComeBackToTheBit) {
    const auto of_heights = [&](auto height) {
        ChunkMesh mesh = mesh_;
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            mesh.vertices[i].H = mesh.vertices[i].coarse_H = height(i);
        const auto bytes = encode_chunk(mesh, kFirst);
        const auto back = decode_chunk(bytes, mesh.id, kFirst, "trial");
        EXPECT_TRUE(back);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            EXPECT_EQ(back->vertices[i].H, mesh.vertices[i].H);
            EXPECT_EQ(std::signbit(back->vertices[i].H), std::signbit(mesh.vertices[i].H));
        }
        return bytes.size();
    };
    const auto noise = [](std::size_t i) { return test::noise(static_cast<int>(i), 3); };
    const auto whole = [&](std::size_t i) { return static_cast<float>(std::round(8000 * noise(i) - 400)); };
    const auto any = [&](std::size_t i) { return static_cast<float>(8000 * noise(i) - 400); };
    EXPECT_LT(of_heights(whole), of_heights(any));
    of_heights([&](std::size_t i) { return whole(i) / 64; });
    of_heights([](std::size_t i) { return i % 2 == 0 ? 0.F : -0.F; });
    of_heights([](std::size_t i) { return i % 2 == 0 ? 1e-38F : 3e38F; });
    of_heights([](std::size_t) { return 0.F; });
}

TEST_F(ChunkCodec, DamagedBytesAreSaid) {
    const auto bytes = encode_chunk(mesh_, kFirst);
    for (std::size_t length = 0; length < bytes.size(); length += 97) {
        EXPECT_FALSE(decode_chunk(std::span(bytes).first(length), mesh_.id, kFirst, "trial")) << length;
    }
    // A flipped bit is found, or gives a mesh whose indices can be used: checksums are the file's.
    for (std::size_t at = 0; at < bytes.size(); at += 31) {
        auto flipped = bytes;
        flipped[at] ^= std::byte{16};
        const auto mesh = decode_chunk(flipped, mesh_.id, kFirst, "trial");
        if (!mesh) {
            EXPECT_EQ(mesh.error().kind, ErrorKind::damaged);
            continue;
        }
        for (const IndexTriangle& t : mesh->triangles) {
            for (const std::uint32_t v : t) ASSERT_LT(v, mesh->vertices.size());
        }
    }
}

}  // namespace
}  // namespace relevo::lod
