#include <algorithm>
#include <array>
#include <cstdint>

#include "lod/machine_clones.hpp"
#include "lod/soar/bits.hpp"
#include "lod/soar/tile_mesher.hpp"

namespace relevo::lod {

namespace {

struct TriangleWriter {
    std::uint32_t* next;

    /// Without a branch: what is not wanted is written over.
    RELEVO_INLINE void write_if(Bits wanted, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        next[0] = a;
        next[1] = b;
        next[2] = c;
        next += 3 * (wanted & 1);
    }
};

/// What a row of squares has, a bit a square.
struct SquareRow {
    Bits first, second;             // halves, of squares whose centre is not in the mesh
    Bits top, bottom, left, right;  // quarters of the others whose side is not split
    Bits top_west, top_east, bottom_west, bottom_east, left_north, left_south, right_north,
        right_south;  // halves of the quarters whose side is
};

/// Squares to be written, in rows of kMostSquares.
struct SquareList {
    std::array<std::uint16_t, TileMesher::kMostSquares * TileMesher::kMostSquares + 8> squares;
    std::uint16_t* end = squares.data();

    RELEVO_INLINE void add(Bits row, int k) { end = list_bits(row, TileMesher::kMostSquares * k, end); }
    const std::uint16_t* begin_all() const { return squares.data(); }
};

}  // namespace

[[RELEVO_CLONES("arch=x86-64-v4", "arch=x86-64-v3", "default")]] void TileMesher::write_triangles(
    const TileGrid& grid, const Quarters& goes_on, MeshOutput& out) const {
    const int squares = squares_;
    const int stride = squares + 1;
    // What lies wholly beyond the data is never seen: squares, and the eastern and southern halves of those
    // whose middle is the data's last column or row.
    const GridPoint first_post = grid.first_post(id_);
    const auto with_data = [&](int first, int last) {
        return std::clamp((last - first + (2 << id_.level) - 1) >> (id_.level + 1), 1, squares);
    };
    const Bits in_row = first_bits(with_data(first_post.column, grid.last_column));
    const int rows = with_data(first_post.row, grid.last_row);
    const auto with_far_half = [&](int first, int last) {
        return std::clamp((last - first + (1 << id_.level) - 1) >> (id_.level + 1), 0, squares);
    };
    const Bits with_east = first_bits(with_far_half(first_post.column, grid.last_column));
    const int rows_with_south = with_far_half(first_post.row, grid.last_row);
    const int half = id_.level > 0 && grid.children(id_.level) == 2 ? squares / 2 : squares;

    std::array<SquareRow, kMostSquares> in_rows;
    SquareList whole, split, ending;
    for (int k = 0; k < rows; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Bits with_south = k < rows_with_south ? ~Bits{0} : 0;
        const Bits top = across_here_[row];
        const Bits bottom = across_here_[row + 1];
        const Bits left = down_here_[row];
        const Bits right = left >> 1;
        const auto [first, second] = parents_of_centres(k);
        in_rows[row] = {.first = first,
                        .second = second,
                        .top = across_seen_[row] & ~top,
                        .bottom = across_seen_[row + 1] & ~bottom & with_south,
                        .left = down_seen_[row] & ~left,
                        .right = (down_seen_[row] >> 1) & ~right & with_east,
                        .top_west = top,
                        .top_east = top & with_east,
                        .bottom_west = bottom & with_south,
                        .bottom_east = bottom & with_south & with_east,
                        .left_north = left,
                        .left_south = left & with_south,
                        .right_north = right & with_east,
                        .right_south = right & with_east & with_south};
        const Bits centres = centre_here_[row] & in_row;
        const std::size_t quarter = k < half ? 0 : 2;
        const Bits no_finer = (goes_on[quarter] ? 0 : first_bits(half)) |
                              (half < squares && !goes_on[quarter + 1] ? ~first_bits(half) : 0);
        whole.add((first | second) & in_row & centre_seen_[row] & ~centre_here_[row], k);
        split.add(centres, k);
        ending.add(centres & no_finer, k);
    }

    TriangleWriter triangles{out.next_index};
    const auto for_each = [&](const SquareList& list, auto write) {
        for (const std::uint16_t* at = list.begin_all(); at != list.end; ++at) {
            const int k = *at / kMostSquares;
            const int i = *at % kMostSquares;
            const std::uint32_t* above = corners.vertex.data() + k * stride + i;
            write(in_rows[static_cast<std::size_t>(k)], i, k, above, above + stride);
        }
    };
    for_each(whole,
             [&](const SquareRow& row, int i, int k, const std::uint32_t* above, const std::uint32_t* below) {
                 const int falls = (i + k) % 2 == 0 ? 1 : 0;  // the diagonal, to the east
                 const std::uint32_t a = falls != 0 ? above[0] : below[0];
                 const std::uint32_t b = falls != 0 ? below[1] : above[1];
                 triangles.write_if(row.first >> i, a, b, above[falls]);
                 triangles.write_if(row.second >> i, b, a, below[1 - falls]);
             });
    for_each(split,
             [&](const SquareRow& row, int i, int k, const std::uint32_t* above, const std::uint32_t* below) {
                 const std::uint32_t centre = centre_[static_cast<std::size_t>(k * squares + i)];
                 triangles.write_if(row.top >> i, above[1], above[0], centre);
                 triangles.write_if(row.bottom >> i, below[0], below[1], centre);
                 triangles.write_if(row.left >> i, above[0], below[0], centre);
                 triangles.write_if(row.right >> i, below[1], above[1], centre);
             });
    for_each(ending,
             [&](const SquareRow& row, int i, int k, const std::uint32_t* above, const std::uint32_t* below) {
                 const std::uint32_t centre = centre_[static_cast<std::size_t>(k * squares + i)];
                 const std::uint32_t* top = across_.data() + k * squares + i;
                 const std::uint32_t bottom = top[squares];
                 const std::uint32_t* left = down_.data() + k * stride + i;
                 triangles.write_if(row.top_east >> i, centre, above[1], *top);
                 triangles.write_if(row.top_west >> i, above[0], centre, *top);
                 triangles.write_if(row.bottom_west >> i, centre, below[0], bottom);
                 triangles.write_if(row.bottom_east >> i, below[1], centre, bottom);
                 triangles.write_if(row.left_north >> i, centre, above[0], left[0]);
                 triangles.write_if(row.left_south >> i, below[0], centre, left[0]);
                 triangles.write_if(row.right_south >> i, centre, below[1], left[1]);
                 triangles.write_if(row.right_north >> i, above[1], centre, left[1]);
             });
    out.next_index = triangles.next;
}

}  // namespace relevo::lod
