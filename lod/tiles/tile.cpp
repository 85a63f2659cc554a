#include "lod/tiles/tile.hpp"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

#include "lod/scene/metric_code.hpp"

namespace relevo::lod {

namespace {

int groups_of(int vertices) {
    return (vertices + Tile::kLanes - 1) / Tile::kLanes;
}

int top_level(const TileGrid& grid) {
    static_assert(Pyramid::kBlockCells == 1 << 8);
    return std::max(grid.levels - 8, 0);
}

}  // namespace

PyramidBlock pyramid_block(const TileGrid& grid, const TileId& id) {
    const int level = std::min(id.level, top_level(grid));
    const GridPoint first = grid.first_post(id);
    return {level, first.column / (Pyramid::kBlockCells << level),
            first.row / (Pyramid::kBlockCells << level)};
}

Tile::Tile(const TileGrid& grid, const TileId& id, const PyramidBlock& block, const VertexPosts& posts,
           const geo::PostPositions& positions, const UndulationGrid& undulations)
    : id_(id),
      squares_(grid.cells(id.level) / 2),
      groups_(groups_of(squares_)),
      groups_down_(groups_of(squares_ + 1)),
      lanes_(static_cast<std::size_t>((2 * squares_ + 1) * groups_ + squares_ * groups_down_)) {
    const GridPoint first = grid.first_post(id);
    const int step = 1 << (id.level - block.level);  // of the block's posts
    const int x0 = (first.column >> block.level) - block.column * Pyramid::kBlockCells;
    const int y0 = (first.row >> block.level) - block.row * Pyramid::kBlockCells;

    Lanes* to = lanes_.data();
    // Vertices at posts (column + 2 i, row) of the tile, i < count, in groups.
    const auto take_row = [&](int column, int row, int count) {
        for (int i = 0; i < groups_of(count) * kLanes; ++i) {
            Lanes& lanes = to[i / kLanes];
            const int lane = i % kLanes;
            if (i >= count) {
                lanes.H[lane] = lanes.N[lane] = 0;
                lanes.error[lane] = lanes.radius[lane] = 0;
                continue;
            }
            const int x = x0 + step * (column + 2 * i);
            const int y = y0 + step * row;
            lanes.H[lane] = posts.heights.at(x, y);
            lanes.N[lane] = static_cast<float>(
                undulations.at(first.column + ((column + 2 * i) << id.level), first.row + (row << id.level)));
            lanes.error[lane] = posts.error.at(x, y);
            lanes.radius[lane] = posts.radius.at(x, y);
        }
        to += groups_of(count);
    };
    for (int k = 0; k < squares_; ++k) take_row(1, 2 * k + 1, squares_);
    for (int k = 0; k <= squares_; ++k) take_row(1, 2 * k, squares_);
    for (int k = 0; k < squares_; ++k) take_row(0, 2 * k + 1, squares_ + 1);

    const int half = std::max(squares_ / 2, 1);
    const auto join = [&](int i, int k, std::uint16_t error) {  // a square's
        std::uint16_t& most = largest_side_error_[static_cast<std::size_t>(2 * (k / half) + i / half)];
        most = std::max(most, error);
    };
    for (int k = 0; k < squares_; ++k) {
        for (int i = 0; i < squares_; ++i) {
            const auto error = [](const Lanes* row, int at) { return row[at / kLanes].error[at % kLanes]; };
            join(i, k,
                 std::max({error(across(k), i), error(across(k + 1), i), error(down(k), i),
                           error(down(k), i + 1)}));
        }
    }
    if (grid.cells(id.level) < TileGrid::kCells)
        largest_side_error_.fill(*std::max_element(largest_side_error_.begin(), largest_side_error_.end()));

    const int middle = squares_;  // posts from the first
    sphere_.post = {first.column + (middle << id.level), first.row + (middle << id.level)};
    sphere_.H = static_cast<double>(posts.heights.at(x0 + step * middle, y0 + step * middle));
    sphere_.N = undulations.at(sphere_.post.column, sphere_.post.row);
    const glm::dvec3 around = positions.at(sphere_.post.column, sphere_.post.row, sphere_.N + sphere_.H);
    for (int k = 0; k < squares_; ++k) {
        for (int i = 0; i < squares_; ++i) {
            const Lanes& lanes = centres(k)[i / kLanes];
            const int lane = i % kLanes;
            if (lanes.radius[lane] == 0) continue;
            const glm::dvec3 at =
                positions.at(first.column + ((2 * i + 1) << id.level), first.row + ((2 * k + 1) << id.level),
                             static_cast<double>(lanes.N[lane]) + static_cast<double>(lanes.H[lane]));
            sphere_.radius_m =
                std::max(sphere_.radius_m,
                         glm::distance(around, at) + static_cast<double>(decode(lanes.radius[lane])));
        }
    }
}

Tile::Place Tile::find(const TileGrid& grid, const GridPoint& vertex) const {
    const GridPoint first = grid.first_post(id_);
    const int x = (vertex.column - first.column) >> id_.level;
    const int y = (vertex.row - first.row) >> id_.level;
    assert(x % 2 != 0 || y % 2 != 0);
    const Lanes* row = x % 2 == 0 ? down(y / 2) : y % 2 == 0 ? across(y / 2) : centres(y / 2);
    return {row + x / 2 / kLanes, x / 2 % kLanes};
}

}  // namespace relevo::lod
