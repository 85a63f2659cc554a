#include "lod/soar/metrics.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "geo/post_positions.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/soar/fine_metrics.hpp"

namespace relevo::lod {

namespace {

constexpr int kSpacing = MeshHeights::kCell;

void join(std::uint16_t& code, std::uint16_t other) {
    const std::atomic_ref<std::uint16_t> shared(code);
    std::uint16_t known = shared.load(std::memory_order_relaxed);
    while (known < other && !shared.compare_exchange_weak(known, other, std::memory_order_relaxed)) {
    }
}

std::uint16_t error_code(double m) {
    return m < kNegligibleM ? std::uint16_t{0} : encode_up(m);
}

GridPoint to_grid(const GridPoint& lattice) {
    return {kSpacing * lattice.column, kSpacing * lattice.row};
}
GridPoint to_lattice(const GridPoint& post) {
    return {post.column / kSpacing, post.row / kSpacing};
}

/// Largest multiple of a size that is not above a value.
int aligned(int value, int size) {
    return value / size * size;
}

}  // namespace

MetricBuilder::MetricBuilder(const MeshGround& ground, ObjectErrors errors)
    : ground_(ground),
      errors_(errors),
      levels_(ground.frame.levels()),
      lattice_levels_(std::max(levels_ - 3, 0)) {
    static_assert(kSpacing == 1 << 3);
    const int side = (ground.frame.padded_side() - 1) / kSpacing + 1;
    for (auto* raster : {&lattice_.bounded, &lattice_.incremental, &lattice_.radius})
        *raster = Raster<std::uint16_t>(side, side);
}

MetricRasters MetricBuilder::add_tile(const BlockGrid::Box& tile, const Raster<float>& heights) {
    const MetricTile posts(ground_, MetricTile::window_of(tile, ground_.frame.padded_side()), heights);
    MetricRasters codes{Raster<std::uint16_t>(tile.columns, tile.rows),
                        Raster<std::uint16_t>(tile.columns, tile.rows),
                        Raster<std::uint16_t>(tile.columns, tile.rows)};
    if (!posts.any_valid()) return codes;
    const MetricRasters fine = fine_metrics(posts, levels_, kFineHalfSize, errors_);
    join_fine(posts, tile, fine);
    if (errors_ == ObjectErrors::both) scan_coarse(posts, tile);

    const int dx = tile.column - posts.window().column;
    const int dy = tile.row - posts.window().row;
    const auto cut = [&](const Raster<std::uint16_t>& from, Raster<std::uint16_t>& to) {
        for (int row = 0; row < tile.rows; ++row)
            std::copy_n(from.row(row + dy) + dx, tile.columns, to.row(row));
    };
    cut(fine.bounded, codes.bounded);
    cut(fine.incremental, codes.incremental);
    cut(fine.radius, codes.radius);
    return codes;
}

/// The coarsest of the fine vertices are the children of the finest on the lattice.
void MetricBuilder::join_fine(const MetricTile& posts, const BlockGrid::Box& tile,
                              const MetricRasters& fine) {
    const int level = 2 * (levels_ - 3);
    if (level <= 0) return;
    const BlockGrid::Box& window = posts.window();
    for (int row = tile.row; row < tile.row + tile.rows; ++row) {
        for_each_vertex_in_row(levels_, level, row, [&](const GridPoint& v) {
            if (v.column < tile.column || v.column >= tile.column + tile.columns) return;
            const int x = v.column - window.column;
            const int y = v.row - window.row;
            const std::uint16_t radius = fine.radius.at(x, y);
            if (radius == 0) return;
            for (const GridPoint& parent : diamond(v, level, levels_).apexes) {
                const GridPoint p = to_lattice(parent);
                join(lattice_.bounded.at(p.column, p.row), fine.bounded.at(x, y));
                join(lattice_.incremental.at(p.column, p.row), fine.incremental.at(x, y));
                const double reach =
                    glm::distance(position(p), posts.position(v)) + static_cast<double>(decode(radius));
                join(lattice_.radius.at(p.column, p.row), encode_up(reach + kRadiusMarginM));
            }
        });
    }
}

/// The tile's posts against all triangles of coarse vertices that they lie in.
void MetricBuilder::scan_coarse(const MetricTile& posts, const BlockGrid::Box& tile) {
    // Borders included: the next tile's first column and row are in the halo.
    const int last = 1 << levels_;
    const BlockGrid::Box box{tile.column, tile.row, std::min(tile.columns + 1, last + 1 - tile.column),
                             std::min(tile.rows + 1, last + 1 - tile.row)};
    for (int level = 0; level < 2 * lattice_levels_; ++level) {
        const int s = kSpacing * half_size(lattice_levels_, level);
        const int size = 2 * s;  // of the squares that the level's triangles are halves or quarters of
        for (int y = aligned(tile.row, size); y < std::min(tile.row + tile.rows, last); y += size) {
            for (int x = aligned(tile.column, size); x < std::min(tile.column + tile.columns, last);
                 x += size) {
                const GridPoint centre{x + s, y + s};
                if (level % 2 == 0) {
                    const Diamond d = diamond(centre, level, levels_);
                    for (const GridPoint& apex : d.apexes)
                        join_scan(posts, box, centre, {{d.left, d.right, apex}, {}});
                } else {
                    const GridPoint corner[4] = {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
                    for (int k = 0; k < 4; ++k) {
                        const GridPoint& a = corner[k];
                        const GridPoint& b = corner[(k + 1) % 4];
                        join_scan(posts, box, midpoint(a, b), {{a, b, centre}, {}});
                    }
                }
            }
        }
    }
}

void MetricBuilder::join_scan(const MetricTile& posts, const BlockGrid::Box& box, const GridPoint& v,
                              const Triangle& triangle) {
    Triangle placed = triangle;
    for (int k = 0; k < 3; ++k) placed.position[k] = ground_.lattice_position(placed.corner[k]);
    const Deviation deviation = posts.deviation(placed, box);
    if (!deviation.any_post()) return;
    const GridPoint p = to_lattice(v);
    join(lattice_.bounded.at(p.column, p.row), error_code(std::sqrt(deviation.max_m2)));
}

glm::dvec3 MetricBuilder::position(const GridPoint& lattice_point) const {
    return ground_.lattice_position(to_grid(lattice_point));
}

void MetricBuilder::finish_vertex(const GridPoint& v, int level) {
    const Diamond d = diamond(v, level, lattice_levels_);
    const glm::dvec3 here = position(v);
    const glm::dvec3 left = position(d.left);
    const glm::dvec3 right = position(d.right);
    const auto is_valid = [&](const GridPoint& p) {
        const GridPoint post = to_grid(p);
        return ground_.fill.lattice_is_valid(post.column, post.row);
    };
    std::uint16_t& bounded = lattice_.bounded.at(v.column, v.row);
    std::uint16_t& incremental = lattice_.incremental.at(v.column, v.row);
    std::uint16_t& radius = lattice_.radius.at(v.column, v.row);
    bool empty = radius == 0 && !is_valid(d.left) && !is_valid(d.right);
    double reach = std::max(glm::distance(here, left), glm::distance(here, right));
    for (const GridPoint& apex : d.apexes) {
        reach = std::max(reach, glm::distance(here, position(apex)));
        empty = empty && !is_valid(apex);
    }
    if (is_valid(v))
        incremental = std::max(incremental, error_code(glm::distance(here, 0.5 * (left + right))));
    for (const GridPoint& child : children(v, level, lattice_levels_)) {
        const std::uint16_t child_radius = lattice_.radius.at(child.column, child.row);
        if (child_radius == 0) continue;
        empty = false;
        bounded = std::max(bounded, lattice_.bounded.at(child.column, child.row));
        incremental = std::max(incremental, lattice_.incremental.at(child.column, child.row));
        reach =
            std::max(reach, glm::distance(here, position(child)) + static_cast<double>(decode(child_radius)));
    }
    if (empty) return;  // the codes stay 0: never drawn, and no sphere to look into
    radius = std::max(radius, encode_up(reach + kRadiusMarginM));
}

MetricRasters MetricBuilder::finish() {
    const int side = lattice_.radius.rows();
    for (int level = 2 * lattice_levels_ - 1; level >= 0; --level) {
        tbb::parallel_for(0, side, [&](int row) {
            for_each_vertex_in_row(lattice_levels_, level, row,
                                   [&](const GridPoint& v) { finish_vertex(v, level); });
        });
    }
    return std::move(lattice_);
}

MetricRasters build_metrics(const geo::GridFrame& frame, const UndulationGrid& undulations,
                            const Raster<float>& heights, ObjectErrors errors) {
    const geo::PostPositions positions(frame);
    MeshHeights fill(frame);
    fill.add(0, 0, heights);
    fill.finish();
    MetricBuilder builder({frame, positions, undulations, fill}, errors);
    const int side = frame.padded_side();
    MetricRasters all{Raster<std::uint16_t>(side, side), Raster<std::uint16_t>(side, side),
                      Raster<std::uint16_t>(side, side)};
    const BlockGrid grid = BlockGrid::of_metrics(side);
    tbb::parallel_for(0, grid.count(), [&](int i) {
        const BlockGrid::Box tile = grid.box(i % grid.across, i / grid.across);
        const BlockGrid::Box window = MetricTile::window_of(tile, side);
        const MetricRasters codes = builder.add_tile(tile, part_of(heights, window));
        paste(codes.bounded, tile, all.bounded);
        paste(codes.incremental, tile, all.incremental);
        paste(codes.radius, tile, all.radius);
    });
    const MetricRasters lattice = builder.finish();
    for (int row = 0; row < side; row += kSpacing) {
        for (int column = 0; column < side; column += kSpacing) {
            const int x = column / kSpacing;
            const int y = row / kSpacing;
            if (lattice.radius.at(x, y) == 0) continue;
            all.bounded.at(column, row) = lattice.bounded.at(x, y);
            all.incremental.at(column, row) = lattice.incremental.at(x, y);
            all.radius.at(column, row) = lattice.radius.at(x, y);
        }
    }
    return all;
}

}  // namespace relevo::lod
