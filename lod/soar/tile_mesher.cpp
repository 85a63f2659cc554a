#include "lod/soar/tile_mesher.hpp"

#include <array>
#include <cmath>

#include "lod/machine_clones.hpp"
#include "lod/soar/bits.hpp"
#include "lod/soar/vertex_placing.hpp"

namespace relevo::lod {

[[RELEVO_CLONES("arch=x86-64-v4", "arch=x86-64-v3", "default")]] TileMesher::Quarters
TileMesher::place_vertices(const FrameTest& test, const TileStore::Resident& resident,
                           const TileGround& ground, unsigned inside, MeshOutput& out) {
    const Tile& tile = resident.tile;
    id_ = tile.id();
    squares_ = tile.squares();
    const int squares = squares_;
    const int stride = squares + 1;
    const TileGrid& grid = ground.grid;
    const auto vertex_level = static_cast<std::size_t>(2 * (grid.levels - 1 - id_.level));
    VertexPlacing placing(test, ground, tile, inside, out);
    std::array<Bits, kMostSquares + 1> candidates;
    std::array<Bits, kMostSquares + 1> allowed;

    Bits any = 0;
    for (int k = 0; k < squares; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const auto [first, second] = parents_of_centres(k);
        candidates[row] = (first | second) & first_bits(squares);
        allowed[row] = first & second;
        any |= candidates[row];
    }
    centre_here_.fill(0);
    across_here_.fill(0);
    down_here_.fill(0);
    centre_seen_.fill(0);
    if (any == 0) return {};
    placing.set_bound(ground.bounds[vertex_level]);
    placing.place(
        {.lanes = tile.centres(0),
         .groups = tile.groups(),
         .first = {1, 1},
         .rows = squares,
         .candidates = candidates.data(),
         .allowed = allowed.data(),
         .here = centre_here_.data(),
         .seen = centre_seen_.data(),
         .vertex = centre_.data(),
         .stride = squares},
        [&](int, int) { return resident.presence; },
        [&](int i, int k) {
            const std::uint32_t* above = corners.vertex.data() + k * stride + i;
            return (i + k) % 2 == 0 ? Ends{above[0], above[stride + 1]} : Ends{above[1], above[stride]};
        });

    // A side on the tile's border has its other parent in the neighbour, where it is if this one needs it:
    // errors and spheres are nested.
    placing.set_bound(ground.bounds[vertex_level + 1]);
    const auto& [north, south, west, east] = resident.side_presence;
    const auto all_if_there = [](double presence) { return presence > 0 ? ~Bits{0} : 0; };
    any = 0;
    for (int k = 0; k <= squares; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Bits above = k > 0 ? centre_here_[row - 1] : 0;
        const Bits below = k < squares ? centre_here_[row] : 0;
        candidates[row] = above | below;
        allowed[row] = k == 0 ? all_if_there(north) : k == squares ? all_if_there(south) : above & below;
        any |= candidates[row];
    }
    if (any == 0) return {};
    placing.place(
        {.lanes = tile.across(0),
         .groups = tile.groups(),
         .first = {1, 0},
         .rows = squares + 1,
         .candidates = candidates.data(),
         .allowed = allowed.data(),
         .here = across_here_.data(),
         .seen = across_seen_.data(),
         .vertex = across_.data(),
         .stride = squares},
        [&](int, int k) { return k == 0         ? north
                                 : k == squares ? south
                                                : resident.presence; },
        [&](int i, int k) {
            const std::uint32_t* left = corners.vertex.data() + k * stride + i;
            return Ends{left[0], left[1]};
        });
    const Bits side_columns = (all_if_there(west) & Bits{1}) | (all_if_there(east) & Bits{1} << squares);
    for (std::size_t row = 0; row < static_cast<std::size_t>(squares); ++row) {
        const Bits centres = centre_here_[row];
        candidates[row] = centres | (centres << 1);
        allowed[row] = (centres & (centres << 1)) | side_columns;
    }
    placing.place(
        {.lanes = tile.down(0),
         .groups = tile.groups_down(),
         .first = {0, 1},
         .rows = squares,
         .candidates = candidates.data(),
         .allowed = allowed.data(),
         .here = down_here_.data(),
         .seen = down_seen_.data(),
         .vertex = down_.data(),
         .stride = stride},
        [&](int i, int) { return i == 0         ? west
                                 : i == squares ? east
                                                : resident.presence; },
        [&](int i, int k) {
            const std::uint32_t* above = corners.vertex.data() + k * stride + i;
            return Ends{above[0], above[stride]};
        });
    if (id_.level == 0) return {};

    Quarters split{};
    const int half = grid.children(id_.level) == 2 ? squares / 2 : squares;
    const Bits west_half = first_bits(half);
    for (int k = 0; k < squares; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Bits split_squares = centre_here_[row] & (across_here_[row] | across_here_[row + 1] |
                                                        down_here_[row] | (down_here_[row] >> 1));
        const std::size_t quarter = k < half ? 0 : 2;
        if ((split_squares & west_half) != 0) split[quarter] = true;
        if ((split_squares & ~west_half) != 0) split[quarter + 1] = true;
    }
    return split;
}

void TileMesher::hand_down(const TileGrid& grid, int quarter, Corners& child) const {
    const bool whole = grid.children(id_.level) == 1;
    const int half = whole ? squares_ : squares_ / 2;  // squares of this tile a side
    const int x0 = whole ? 0 : quarter % 2 * half;
    const int y0 = whole ? 0 : quarter / 2 * half;
    const int stride = squares_ + 1;
    const int child_stride = 2 * half + 1;
    // Bits of two rows, one between the other.
    const auto spread = [](Bits bits) {
        bits = (bits | bits << 16) & 0x0000ffff0000ffff;
        bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
        bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
        bits = (bits | bits << 2) & 0x3333333333333333;
        return (bits | bits << 1) & 0x5555555555555555;
    };
    for (int k = 0; k <= half; ++k) {
        const int y = y0 + k;
        const auto row = static_cast<std::size_t>(y);
        const Bits at_corners = corners.here[row] >> x0 & first_bits(half + 1);
        const Bits at_sides = across_here_[row] >> x0 & first_bits(half);
        child.here[static_cast<std::size_t>(2 * k)] = spread(at_corners) | spread(at_sides) << 1;
        std::uint32_t* to = child.vertex.data() + 2 * k * child_stride;
        const std::uint32_t* corner = corners.vertex.data() + y * stride + x0;
        const std::uint32_t* across = across_.data() + y * squares_ + x0;
        for (int i = 0; i < half; ++i) {
            to[2 * i] = corner[i];
            to[2 * i + 1] = across[i];
        }
        to[2 * half] = corner[half];
        if (k == half) break;
        const Bits down = down_here_[row] >> x0 & first_bits(half + 1);
        const Bits centres = centre_here_[row] >> x0 & first_bits(half);
        child.here[static_cast<std::size_t>(2 * k + 1)] = spread(down) | spread(centres) << 1;
        to += child_stride;
        const std::uint32_t* side = down_.data() + y * stride + x0;
        const std::uint32_t* centre = centre_.data() + y * squares_ + x0;
        for (int i = 0; i < half; ++i) {
            to[2 * i] = side[i];
            to[2 * i + 1] = centre[i];
        }
        to[2 * half] = side[half];
    }
}

}  // namespace relevo::lod
