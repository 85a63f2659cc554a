#include "lod/soar/refiner.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "lod/scene/metric_code.hpp"
#include "lod/soar/tile_mesher.hpp"

namespace relevo::lod {

namespace {

/// Kept of tau for the rounding of drawn positions to float.
constexpr double kFloatShare = 1e-3;

/// The band of screen-space errors over which a vertex comes in, such that the drawn error is at most tau:
/// with the morph factor linear in 1 / rho, the integral of rho over it is 2 ln(2) tau_min (docs/design.md).
double tau_min_of(const RefineOptions& options) {
    const double tau = options.tau_px * (1 - kFloatShare);
    return options.morph ? tau / (2 * std::numbers::ln2) : tau;
}

constexpr unsigned kInsideAll = 0xf;  // a bit a side plane: all of a tile is inside it

/// Tiles a core that a frame is cut into before the cores share them out.
constexpr std::size_t kTilesACore = 12;

}  // namespace

/// What refining takes, kept from frame to frame.
struct Refiner::Workshop {
    explicit Workshop(const Terrain& of)
        : terrain(of),
          tiles(of.tiles()),
          tables(of.positions(), of.levels()),
          ground{tiles.grid(), of.positions(), tables, of.level_bounds()} {}

    /// A tile to be refined with all that is in it.
    struct Task {
        const TileStore::Resident* resident = nullptr;
        unsigned inside = 0;  // planes
        TileMesher::Corners corners;
    };
    /// What a thread refines with.
    struct Bench {
        std::vector<TileMesher> meshers;  // by level
        // The part of the mesh's vertices that the thread may still fill.
        std::uint32_t next_vertex = 0;
        std::uint32_t end_vertex = 0;
    };

    const Terrain& terrain;
    const TileStore& tiles;
    const LevelTables tables;
    const TileGround ground;
    FrameTest test;
    Mesh mesh;
    std::vector<PlacedVertex> placed;
    std::vector<Task> tasks;  // kept for their room; the first task_count are this frame's
    std::size_t task_count = 0;
    std::vector<Mesh::Indices> task_indices;
    Mesh::Indices coarse_indices;  // of the tiles before there were tasks
    tbb::enumerable_thread_specific<Bench> benches;
    std::atomic<std::size_t> vertices_given{0};
    std::atomic<bool> is_full{false};

    void prepare(const View& view, const RefineOptions& options);
    void run(bool parallel);
    void set_fixed_vertices();
    Bench& bench();
    bool reserve(Bench& bench);
    void refine(Bench& bench, const Task& task, Mesh::Indices& into);
    void refine(Bench& bench, const TileStore::Resident& resident, unsigned inside, Mesh::Indices& into,
                bool hand_out);
    bool is_outside(const Tile& tile, unsigned& inside) const;
    double urgency(const Tile& tile, int quarter) const;
    void look_ahead(const TileStore::Resident& resident, unsigned inside) const;
    void gather();
};

void Refiner::Workshop::prepare(const View& view, const RefineOptions& options) {
    const View::ErrorScale scale = view.error_scale();
    test.eye = view.eye().m;
    test.planes = view.side_planes();
    test.exaggeration = options.exaggeration;
    test.tau_min_px = tau_min_of(options);
    test.lambda_px = scale.lambda_px;
    test.kappa = scale.kappa;
    test.reach = scale.lambda_px / test.tau_min_px + scale.kappa;
    test.morph = options.morph;
    test.moving = options.morph || tiles.is_fading();
    test.cull = options.cull;
    test.view_distance_m = options.view_distance_m;
}

/// The grid's corners are always there.
void Refiner::Workshop::set_fixed_vertices() {
    for (std::size_t k = 0; k < 4; ++k) {
        const TileStore::Corner& corner = tiles.corners()[k];
        const auto& [column, row] = corner.post;
        const glm::dvec3 at =
            terrain.positions().at(column, row, corner.N + test.exaggeration * corner.H) - test.eye;
        placed[k] = {at, at};
        mesh.vertices[k] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z),
                            static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)};
    }
}

Refiner::Workshop::Bench& Refiner::Workshop::bench() {
    Bench& mine = benches.local();
    if (mine.meshers.empty()) mine.meshers.resize(static_cast<std::size_t>(tiles.grid().levels));
    return mine;
}

/// Room for the vertices of one more tile; false where the mesh's buffer is at its end.
bool Refiner::Workshop::reserve(Bench& bench) {
    if (bench.end_vertex - bench.next_vertex >= kMostTileVertices) return true;
    constexpr std::size_t kShare = 4 * kMostTileVertices;
    const std::size_t begin = vertices_given.fetch_add(kShare, std::memory_order_relaxed);
    if (begin + kShare > mesh.vertices.size()) {
        is_full = true;
        return false;
    }
    // A thread that is alone goes on where it was; else a few vertices stay unused.
    if (begin != bench.end_vertex) {
        std::fill(mesh.vertices.begin() + bench.next_vertex, mesh.vertices.begin() + bench.end_vertex,
                  mesh.vertices.front());
        bench.next_vertex = static_cast<std::uint32_t>(begin);
    }
    bench.end_vertex = static_cast<std::uint32_t>(begin + kShare);
    return true;
}

/// Is a tile outside the picture, or beyond the view distance? Adds the planes that it is wholly inside of.
bool Refiner::Workshop::is_outside(const Tile& tile, unsigned& inside) const {
    const Tile::Sphere& sphere = tile.sphere();
    const double exaggeration = test.exaggeration;
    const glm::dvec3 offset =
        terrain.positions().at(sphere.post.column, sphere.post.row, sphere.N + exaggeration * sphere.H) -
        test.eye;
    double radius = exaggeration * sphere.radius_m;
    if (exaggeration != 1) {
        // The sphere of the square's middle, of the bare surface, holds the bare tile.
        const int level = std::max(2 * (tiles.grid().levels - tile.id().level) -
                                       2 * std::countr_zero(static_cast<unsigned>(2 * tile.squares())),
                                   0);
        radius +=
            2 * std::abs(exaggeration - 1) * terrain.level_bounds()[static_cast<std::size_t>(level)].radius_m;
    }
    if (glm::length(offset) - radius > test.view_distance_m) return true;
    for (unsigned k = 0; k < 4; ++k) {
        if ((inside >> k & 1) != 0) continue;
        const double distance = glm::dot(test.planes[k], offset);
        if (distance > radius) return true;
        if (distance < -radius) inside |= 1u << k;
    }
    return false;
}

/// How much a quarter of a tile may gain from finer tiles, about: pixels of error at its middle.
double Refiner::Workshop::urgency(const Tile& tile, int quarter) const {
    const Tile::Sphere& sphere = tile.sphere();
    const int offset =
        tiles.grid().children(tile.id().level) == 2 ? tile.squares() / 2 << tile.id().level : 0;
    const glm::dvec3 middle =
        terrain.positions().at(sphere.post.column + (quarter % 2 == 0 ? -offset : offset),
                               sphere.post.row + (quarter / 2 == 0 ? -offset : offset),
                               sphere.N + test.exaggeration * sphere.H) -
        test.eye;
    const double error = static_cast<double>(decode(tile.largest_side_error(quarter % 2, quarter / 2)));
    return test.lambda_px * error / std::max(glm::length(middle) - 0.5 * sphere.radius_m, 1.0);
}

void Refiner::Workshop::refine(Bench& bench, const Task& task, Mesh::Indices& into) {
    bench.meshers[static_cast<std::size_t>(task.resident->tile.id().level)].corners = task.corners;
    refine(bench, *task.resident, task.inside, into, false);
}

/// Refines a tile whose mesher has its corners. \param hand_out  make tasks of its children rather than
/// refine them, too
void Refiner::Workshop::refine(Bench& bench, const TileStore::Resident& resident, unsigned inside,
                               Mesh::Indices& into, bool hand_out) {
    if (is_full || !reserve(bench)) return;
    const Tile& tile = resident.tile;
    if (is_outside(tile, inside)) return;
    tiles.use(resident);
    const TileGrid& grid = tiles.grid();
    const TileId id = tile.id();
    TileMesher& mesher = bench.meshers[static_cast<std::size_t>(id.level)];

    MeshOutput out{mesh.vertices.data(), placed.data(), bench.next_vertex, nullptr};
    const TileMesher::Quarters split = mesher.place_vertices(test, resident, ground, inside, out);
    bench.next_vertex = out.next_vertex;

    TileMesher::Quarters goes_on{};
    std::array<const TileStore::Resident*, 4> child{};
    const int across = id.level > 0 ? grid.children(id.level) : 0;
    for (int quarter = 0; quarter < across * across; ++quarter) {
        const auto k = static_cast<std::size_t>(quarter);
        if (!split[k]) continue;
        const TileId below{id.level - 1, across * id.column + quarter % 2, across * id.row + quarter / 2};
        child[k] = tiles.find(below);
        goes_on[k] = child[k] != nullptr;
        if (!goes_on[k]) tiles.want(below, urgency(tile, quarter));
    }
    if (across == 1) goes_on = {goes_on[0], goes_on[0], goes_on[0], goes_on[0]};

    const std::size_t before = into.size();
    into.resize(before + kMostTileIndices);
    out.next_index = into.data() + before;
    mesher.write_triangles(grid, goes_on, out);
    into.resize(static_cast<std::size_t>(out.next_index - into.data()));

    for (int quarter = 0; quarter < across * across; ++quarter) {
        const TileStore::Resident* next = child[static_cast<std::size_t>(quarter)];
        if (next == nullptr) continue;
        if (hand_out) {
            if (task_count == tasks.size()) tasks.emplace_back();
            Task& task = tasks[task_count++];
            task.resident = next;
            task.inside = inside;
            mesher.hand_down(grid, quarter, task.corners);
        } else {
            mesher.hand_down(grid, quarter, bench.meshers[static_cast<std::size_t>(id.level - 1)].corners);
            refine(bench, *next, inside, into, false);
        }
    }
}

void Refiner::Workshop::run(bool parallel) {
    is_full = false;
    vertices_given = 4;
    for (Bench& bench : benches) bench.next_vertex = bench.end_vertex = 4;
    set_fixed_vertices();
    coarse_indices.clear();
    task_count = 0;

    Bench& mine = bench();
    const TileStore::Resident* root = tiles.find(tiles.grid().root());
    if (root == nullptr) return;
    TileMesher& mesher = mine.meshers.back();
    mesher.corners.here = {3, 3};
    mesher.corners.vertex[0] = 0;  // north-west, north-east, south-west, south-east
    mesher.corners.vertex[1] = 3;
    mesher.corners.vertex[2] = 1;
    mesher.corners.vertex[3] = 2;
    const unsigned inside = test.cull ? 0 : kInsideAll;
    refine(mine, *root, inside, coarse_indices, parallel);
    if (!parallel) return;

    // The coarsest tiles first, one after the other, until there is enough for all cores to share.
    const std::size_t enough =
        kTilesACore * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    std::size_t done = 0;
    while (done < task_count && task_count - done < enough) {
        Task task = tasks[done++];
        mine.meshers[static_cast<std::size_t>(task.resident->tile.id().level)].corners = task.corners;
        refine(mine, *task.resident, task.inside, coarse_indices, true);
    }
    if (task_indices.size() < task_count) task_indices.resize(task_count);
    for (std::size_t i = 0; i < task_count; ++i) task_indices[i].clear();
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(done, task_count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            Bench& its = bench();
            for (std::size_t i = range.begin(); i < range.end(); ++i) refine(its, tasks[i], task_indices[i]);
        },
        tbb::simple_partitioner{});
}

/// Puts the indices of all tasks together.
void Refiner::Workshop::gather() {
    std::uint32_t end = 4;
    for (const Bench& bench : benches) end = std::max(end, bench.next_vertex);
    for (const Bench& bench : benches) {
        if (bench.next_vertex == end) continue;
        std::fill(mesh.vertices.begin() + bench.next_vertex,
                  mesh.vertices.begin() + std::min(bench.end_vertex, end), mesh.vertices.front());
    }
    mesh.vertices.resize(end);
    mesh.indices.clear();
    if (task_count == 0) {
        mesh.indices.swap(coarse_indices);
        return;
    }
    std::vector<std::size_t> begin{coarse_indices.size()};
    for (std::size_t i = 0; i < task_count; ++i) begin.push_back(begin.back() + task_indices[i].size());
    mesh.indices.resize(begin.back());
    std::copy(coarse_indices.begin(), coarse_indices.end(), mesh.indices.begin());
    tbb::parallel_for(std::size_t{0}, task_count, [&](std::size_t i) {
        std::copy(task_indices[i].begin(), task_indices[i].end(),
                  mesh.indices.begin() + static_cast<std::ptrdiff_t>(begin[i]));
    });
}

Refiner::Refiner(const Terrain& terrain) : workshop_(std::make_unique<Workshop>(terrain)) {}

Refiner::~Refiner() = default;

const Mesh& Refiner::refine(const View& view, const RefineOptions& options) {
    assert(options.tau_px > 0 && options.exaggeration >= 0);
    Workshop& shop = *workshop_;
    shop.prepare(view, options);
    // As much room as the buffers have; where that is not enough, once more with twice as much.
    for (std::size_t room = std::max(shop.placed.size(), std::size_t{1} << 16);; room *= 2) {
        shop.mesh.vertices.resize(room);
        shop.placed.resize(room);
        shop.run(options.parallel);
        if (!shop.is_full) break;
    }
    shop.gather();
    return shop.mesh;
}

/// Without a mesh there is only a bound: a tile's largest error, at the nearest point of its sphere.
void Refiner::Workshop::look_ahead(const TileStore::Resident& resident, unsigned inside) const {
    const Tile& tile = resident.tile;
    const TileId id = tile.id();
    if (id.level == 0 || is_outside(tile, inside)) return;
    const Tile::Sphere& sphere = tile.sphere();
    const glm::dvec3 offset =
        terrain.position(sphere.post.column, sphere.post.row, sphere.H, test.exaggeration) - test.eye;
    const double nearest = glm::length(offset) - test.exaggeration * sphere.radius_m;
    const int across = tiles.grid().children(id.level);
    for (int quarter = 0; quarter < across * across; ++quarter) {
        const double error = static_cast<double>(decode(tile.largest_side_error(quarter % 2, quarter / 2)));
        if (test.reach * test.exaggeration * error < nearest) continue;
        const TileId below{id.level - 1, across * id.column + quarter % 2, across * id.row + quarter / 2};
        if (const TileStore::Resident* child = tiles.find(below)) {
            look_ahead(*child, inside);
        } else {
            tiles.want(below, urgency(tile, quarter), TileNeed::soon);
        }
    }
}

void Refiner::look_ahead(const View& view, const RefineOptions& options) {
    Workshop& shop = *workshop_;
    shop.prepare(view, options);
    if (const auto* root = shop.tiles.find(shop.tiles.grid().root()))
        shop.look_ahead(*root, options.cull ? 0 : kInsideAll);
}

Result<const Mesh*> Refiner::refine_whole(const View& view, const RefineOptions& options) {
    TileStore& tiles = workshop_->terrain.tiles();
    for (;;) {
        tiles.start_frame();
        const Mesh& mesh = refine(view, options);
        tiles.start_frame();  // hands over what was missing
        if (auto failure = tiles.failure()) return *failure;
        const TileStore::Figures figures = tiles.figures();
        if (figures.starved()) {
            return Error{ErrorKind::input,
                         fmt::format("the view needs {} more tiles than fit in the memory for them; ask for "
                                     "less detail (--tau) or allow more (--memory)",
                                     figures.pending_tiles)};
        }
        if (figures.pending_tiles == 0 && !tiles.is_fading()) return &mesh;
        if (!tiles.wait()) std::this_thread::sleep_for(std::chrono::milliseconds(5));  // only a fade is left
    }
}

}  // namespace relevo::lod
