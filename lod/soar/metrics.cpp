#include "lod/soar/metrics.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "geo/post_positions.hpp"
#include "lod/scene/metric_code.hpp"
#include "lod/soar/coarse_scan.hpp"
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

/// What a tile is computed in. It is large, and made once for each thread.
struct MetricBuilder::Workspace {
    MetricTile posts;
    FineMetrics fine;
    CoarseScan coarse;
};

class MetricBuilder::Workspaces {
  public:
    std::unique_ptr<Workspace> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::make_unique<Workspace>();
        auto one = std::move(free_.back());
        free_.pop_back();
        return one;
    }
    void give_back(std::unique_ptr<Workspace> one) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(one));
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Workspace>> free_;
};

MetricBuilder::MetricBuilder(const MeshGround& ground, ObjectErrors errors)
    : ground_(ground),
      errors_(errors),
      levels_(ground.frame.levels()),
      lattice_levels_(std::max(levels_ - 3, 0)),
      workspaces_(std::make_unique<Workspaces>()) {
    static_assert(kSpacing == 1 << 3);
    const int side = (ground.frame.padded_side() - 1) / kSpacing + 1;
    for (auto* raster : {&lattice_.bounded, &lattice_.incremental, &lattice_.radius})
        *raster = Raster<std::uint16_t>(side, side);
}

MetricBuilder::~MetricBuilder() = default;

MetricRasters MetricBuilder::add_tile(const BlockGrid::Box& tile, const Raster<float>& heights) {
    auto work = workspaces_->take();
    const int side = ground_.frame.padded_side();
    const BlockGrid::Box window = MetricTile::window_of(tile, side);
    const BlockGrid::Box bordered{tile.column, tile.row, std::min(tile.columns + 1, side - tile.column),
                                  std::min(tile.rows + 1, side - tile.row)};
    work->posts.begin(ground_, window, heights);
    MetricRasters codes;
    if (!work->posts.any_valid()) {
        const Raster<std::uint16_t> none(bordered.columns, bordered.rows);
        codes = {none, none, none};
    } else {
        const bool scanned = errors_ == ObjectErrors::both && lattice_levels_ > 0;
        const int end = window.row + window.rows;
        work->fine.begin(work->posts, levels_, kFineHalfSize, errors_);
        int row = tile.row;  // of the lattice, to be scanned
        // All that looks at every post follows its placing closely, while it is in the processor's cache.
        while (work->posts.placed_end() < end) {
            work->posts.place_until(std::min(work->posts.placed_end() + 2 * kSpacing, end));
            work->fine.build_placed();
            const int placed = work->posts.placed_end();
            for (; scanned && row < tile.row + tile.rows && (row + kSpacing < placed || placed == end);
                 row += kSpacing)
                scan_finest_coarse(*work, tile, row);
        }
        join_fine(*work, tile);
        if (scanned) scan_coarse(*work, tile);
        codes = work->fine.codes(bordered);
    }
    workspaces_->give_back(std::move(work));
    return codes;
}

/// The coarsest of the fine vertices are the children of the finest on the lattice.
void MetricBuilder::join_fine(const Workspace& work, const BlockGrid::Box& tile) {
    const int level = 2 * (levels_ - 3);
    if (level <= 0) return;
    for (int row = tile.row + kFineHalfSize; row < tile.row + tile.rows; row += kSpacing) {
        for (int column = tile.column + kFineHalfSize; column < tile.column + tile.columns;
             column += kSpacing) {
            const GridPoint v{column, row};
            const float radius = work.fine.radius(v);
            if (radius <= 0) continue;
            const std::uint16_t bounded = errors_ == ObjectErrors::both
                                              ? encode_up(static_cast<double>(work.fine.bounded(v)))
                                              : std::uint16_t{0};
            const std::uint16_t incremental = encode_up(static_cast<double>(work.fine.incremental(v)));
            const glm::dvec3 here = work.posts.position(v);
            for (const GridPoint& parent : diamond(v, level, levels_).apexes) {
                const GridPoint p = to_lattice(parent);
                join(lattice_.bounded.at(p.column, p.row), bounded);
                join(lattice_.incremental.at(p.column, p.row), incremental);
                const double reach =
                    glm::distance(work.posts.position(parent), here) + static_cast<double>(radius);
                join(lattice_.radius.at(p.column, p.row), encode_up(reach + kRadiusMarginM));
            }
        }
    }
}

void MetricBuilder::join_error(const GridPoint& v, double m) {
    const GridPoint p = to_lattice(v);
    join(lattice_.bounded.at(p.column, p.row), error_code(m));
}

/// The vertices of the two finest levels on the lattice in one row: their diamonds lie in the tile and its
/// halo.
void MetricBuilder::scan_finest_coarse(const Workspace& work, const BlockGrid::Box& tile, int row) {
    constexpr int s = kSpacing;
    static_assert(s <= DiamondPosts::kReach && s <= MetricTile::kHalo && 2 * s == MetricTile::kClasses);
    const MetricTile& posts = work.posts;
    std::array<double, kMostLanes> m2;
    const bool odd_row = (row / s) % 2 == 1;
    const auto scan = [&](const GridPoint& first, int level, int lane_step) {
        diamond_posts(first, level, s)
            .deviation2(posts.at(0), posts.holes(0), posts.offsets(first, s), posts.lanes(), m2.data());
        for (int k = 0; k < posts.lanes(); k += lane_step) {
            const int column = first.column + k * MetricTile::kClasses;
            const double own = m2[static_cast<std::size_t>(k)];
            if (own > 0 && column >= tile.column && column < tile.column + tile.columns)
                join_error({column, row}, std::sqrt(own));
        }
    };
    const int level = 2 * lattice_levels_ - (odd_row ? 2 : 1);
    const int first_column = posts.first_column();
    if (!odd_row) return scan({first_column + s, row}, level, 1);
    scan({first_column, row}, level + 1, 1);
    // The diamonds of squares' centres look alike at every second lane only.
    scan({first_column + s, row}, level, 2);
    scan({first_column + s + MetricTile::kClasses, row}, level, 2);
}

/// What is known already of a coarse vertex's nested error: at least its children's. That the other tiles may
/// have added to it changes no result, as what is added last is a maximum of all.
double MetricBuilder::known_error(const GridPoint& v, int level) {
    const GridPoint p = to_lattice(v);
    std::uint16_t& known = lattice_.bounded.at(p.column, p.row);
    for (const GridPoint& c : children(p, level, lattice_levels_))
        join(known, std::atomic_ref<std::uint16_t>(lattice_.bounded.at(c.column, c.row))
                        .load(std::memory_order_relaxed));
    return static_cast<double>(decode(std::atomic_ref<std::uint16_t>(known).load(std::memory_order_relaxed)));
}

/// The tile's posts against all larger triangles that they lie in.
void MetricBuilder::scan_coarse(Workspace& work, const BlockGrid::Box& tile) {
    // Borders included: the next tile's first column and row are in the halo.
    const int last = 1 << levels_;
    const BlockGrid::Box box{tile.column, tile.row, std::min(tile.columns + 1, last + 1 - tile.column),
                             std::min(tile.rows + 1, last + 1 - tile.row)};
    work.coarse.prepare(work.posts, work.fine, box);
    for (int level = 2 * lattice_levels_ - 3; level >= 0; --level) {
        const auto scan = [&](const GridPoint& v, const GridPoint& a, const GridPoint& b,
                              const GridPoint& c) {
            Triangle triangle{{a, b, c}, {}};
            for (std::size_t k = 0; k < 3; ++k)
                triangle.position[k] = ground_.lattice_position(triangle.corner[k]);
            const double known = known_error(v, level);
            const double own = work.coarse.largest_distance(triangle, known);
            if (own > known) join_error(v, own);
        };
        const int s = kSpacing * half_size(lattice_levels_, level);
        const int size = 2 * s;  // of the squares that the level's triangles are halves or quarters of
        for (int y = aligned(tile.row, size); y < std::min(tile.row + tile.rows, last); y += size) {
            for (int x = aligned(tile.column, size); x < std::min(tile.column + tile.columns, last);
                 x += size) {
                const GridPoint centre{x + s, y + s};
                if (level % 2 == 0) {
                    const Diamond d = diamond(centre, level, levels_);
                    for (const GridPoint& apex : d.apexes) scan(centre, d.left, d.right, apex);
                } else {
                    const GridPoint corner[4] = {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
                    for (int k = 0; k < 4; ++k) {
                        const GridPoint& a = corner[k];
                        const GridPoint& b = corner[(k + 1) % 4];
                        scan(midpoint(a, b), a, b, centre);
                    }
                }
            }
        }
    }
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
        const BlockGrid::Box own{0, 0, tile.columns, tile.rows};
        paste(part_of(codes.bounded, own), tile, all.bounded);
        paste(part_of(codes.incremental, own), tile, all.incremental);
        paste(part_of(codes.radius, own), tile, all.radius);
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
