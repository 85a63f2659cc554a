#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "lod/lstr/chunk_set.hpp"
#include "lod/scene/sha256.hpp"

// How chunks.bin lies on disk (docs/scene-format.md): a head, a row for every node, the nodes' meshes.
// Numbers are little-endian, as the machines are that this runs on.

namespace relevo::lod {

inline constexpr std::array<char, 8> kChunkMagic{'r', 'e', 'l', 'c', 'h', 'n', 'k', '5'};

template <std::size_t N>
std::array<char, N> start_of(const std::string& text) {
    std::array<char, N> start{};
    std::copy_n(text.begin(), std::min(N, text.size()), start.begin());
    return start;
}

struct ChunkFileHead {
    std::array<char, 8> magic = kChunkMagic;
    std::array<char, 64> scene{};  ///< SHA-256 of its scene.json
    double first_error_m = 0;      ///< ChunkErrors
    std::uint64_t filter = 0;      ///< RemovalTest
    std::uint64_t nodes = 0;       ///< rows that follow
    std::uint64_t end = 0;         ///< of what is written and counts
    std::uint64_t finished = 0;    ///< 1: all rows are there
};
static_assert(std::is_trivially_copyable_v<ChunkFileHead> && sizeof(ChunkFileHead) == 112);

/// All zero: the node is not there yet.
struct ChunkRow {
    // Flags.
    static constexpr std::uint32_t kThere = 1;
    static constexpr std::uint32_t kDraft = 2;  ///< of a subtree whose parent is not there: it does not move
    static constexpr std::uint32_t kReplaced = 4;  ///< by `relevo chunks replace`

    std::uint64_t offset, bytes;
    std::array<char, 16> checksum;  ///< of the mesh: its SHA-256 begins so
    std::uint32_t flags, vertices;
    double error_m, moved_error_m, most_H_m;
    std::array<double, 3> middle, half;  ///< of the box
    std::array<char, 16> own_checksum;   ///< of what stands before it in the row

    std::array<char, 16> own() const {
        return start_of<16>(
            sha256_hex({reinterpret_cast<const std::byte*>(this), sizeof(*this) - sizeof(own_checksum)}));
    }
};
static_assert(std::is_trivially_copyable_v<ChunkRow> && sizeof(ChunkRow) == 128);

}  // namespace relevo::lod
