#include "lod/lstr/chunk_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "lod/lstr/chunk_shape.hpp"
#include "lod/pyramid/block_cache.hpp"
#include "lod/soar/cell.hpp"

namespace relevo::lod {

namespace {

/// Of the distance at which a level gives way, where its morph begins at the latest.
constexpr double kMorphFrom = 0.75;

/// A node ready to be drawn: exact positions, so that nodes agree on what they share.
struct PlacedChunk {
    std::vector<glm::dvec3> positions;  // ECEF
    std::vector<float> rise_m;          // to the coarser level, along the ellipsoid's normal
    std::vector<GridPoint> posts;
    std::vector<IndexTriangle> triangles;
    std::array<std::vector<SideVertex>, kSides> sides;

    std::uint64_t bytes() const {
        return positions.size() * (sizeof(glm::dvec3) + sizeof(float) + sizeof(GridPoint)) +
               triangles.size() * sizeof(IndexTriangle);
    }
};
using Leaves = std::array<PlacedChunk, 4>;

PlacedChunk placed(const Terrain& terrain, const ChunkMesh& mesh, double exaggeration) {
    PlacedChunk made;
    made.triangles = mesh.triangles;
    made.sides = mesh.sides;
    for (const ChunkVertex& vertex : mesh.vertices) {
        made.positions.push_back(
            terrain.position(vertex.at.column, vertex.at.row, static_cast<double>(vertex.H), exaggeration));
        made.rise_m.push_back(static_cast<float>(
            exaggeration * (static_cast<double>(vertex.coarse_H) - static_cast<double>(vertex.H))));
        made.posts.push_back(vertex.at);
    }
    return made;
}

/// What a leaf is made of when it is not read from anywhere: all of its posts.
ChunkMesh leaf_mesh(const Terrain& terrain, const ChunkId& id, const Raster<float>& block,
                    const CoarseSurface* coarse) {
    ChunkMesh mesh{id, 0, 0, {}, {}, {}};
    const GridPoint first = id.first();
    const int cells = std::min(id.cells(), block.columns() - 1);
    const int in_block = Pyramid::kBlockCells - 1;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const GridPoint at{first.column + column, first.row + row};
            const float H = block.at((first.column & in_block) + column, (first.row & in_block) + row);
            ChunkVertex vertex{at, H, H};
            bool kept = true;
            if (coarse != nullptr) {
                vertex.coarse_H =
                    coarse->height({at, H, terrain.position(at.column, at.row, static_cast<double>(H), 1)});
                kept = coarse->has(at);
            }
            const auto index = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(vertex);
            if (column == 0) mesh.sides[0].push_back({index, kept});
            if (column == cells) mesh.sides[1].push_back({index, kept});
            if (row == 0) mesh.sides[2].push_back({index, kept});
            if (row == cells) mesh.sides[3].push_back({index, kept});
        }
    }
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            for (const CellTriangle& t : cell_triangles({column, row})) {
                const auto index = [&](const GridPoint& p) {
                    return static_cast<std::uint32_t>(p.row * (cells + 1) + p.column);
                };
                mesh.triangles.push_back({index(t[0]), index(t[1]), index(t[2])});
            }
        }
    }
    return mesh;
}

ChunkId beside(const ChunkId& id, Side side) {
    ChunkId other = id;
    if (side == Side::west) --other.column;
    if (side == Side::east) ++other.column;
    if (side == Side::north) --other.row;
    if (side == Side::south) ++other.row;
    return other;
}

}  // namespace

std::vector<ChunkRange> chunk_ranges(const std::vector<ChunkSet::Level>& levels, const View& view,
                                     const RefineOptions& options) {
    const View::ErrorScale scale = view.error_scale(options.tau_px);
    std::vector<ChunkRange> ranges(levels.size());
    double before = 0;   // the last level's end
    double finer_m = 0;  // its error
    for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
        const ChunkSet::Level& next = levels[level + 1];
        // Exaggerated heights are off by as many times as much, and the curvature is not exaggerated.
        const double reached_m =
            options.morph ? std::max(next.error_m, levels[level].moved_error_m) : next.error_m;
        const double error_m = std::max(reached_m * std::max(options.exaggeration, 1.0), finer_m);
        const double diameter_m = levels[level].diameter_m + 2 * std::abs(options.exaggeration - 1) *
                                                                 levels[level].most_H_m * std::sqrt(3.0);
        // A vertex of this level may be as far as the level below ends and this one's node is wide.
        const double farthest = level == 0 ? 0 : before + diameter_m;
        double until = (scale.lambda_px / options.tau_px + scale.kappa) * error_m;
        until = std::max(until, options.morph ? farthest / kMorphFrom : farthest);
        double from = until;
        if (options.morph) {
            // In between the error grows in line with the distance, from this level's.
            from = std::max(
                {farthest, std::min(kMorphFrom, 0.95) * until, error_m > 0 ? until * finer_m / error_m : 0});
            from = std::min(from, 0.95 * until);
        }
        ranges[level] = {from, until};
        before = until;
        finer_m = error_m;
    }
    ranges.back() = {INFINITY, INFINITY};
    return ranges;
}

struct ChunkMesher::Workshop {
    const Terrain& terrain;
    const ChunkSet& chunks;
    Mesh mesh;
    std::vector<ChunkId> selected;
    std::vector<std::shared_ptr<const void>> holding;
    std::vector<const PlacedChunk*> drawn;
    std::unique_ptr<BlockCache<ChunkId, PlacedChunk>> nodes;
    std::unique_ptr<BlockCache<ChunkId, Leaves>> leaves;  // by parent
    std::unique_ptr<BlockCache<PyramidBlock, BlockHeights>> blocks;
    double exaggeration = 1;

    Workshop(const Terrain& of, const ChunkSet& set) : terrain(of), chunks(set) { forget(); }

    void forget() {
        constexpr std::uint64_t kBytes = std::uint64_t{128} << 20;
        nodes = std::make_unique<BlockCache<ChunkId, PlacedChunk>>(kBytes);
        leaves = std::make_unique<BlockCache<ChunkId, Leaves>>(kBytes);
        if (!blocks) blocks = std::make_unique<BlockCache<PyramidBlock, BlockHeights>>(kBytes / 4);
    }

    void select(const ChunkId& id, const View& view, const RefineOptions& options,
                const std::vector<ChunkRange>& ranges);
    Result<std::shared_ptr<const PlacedChunk>> node(const ChunkId& id);
    Result<std::shared_ptr<const Leaves>> leaves_of(const ChunkId& parent);
    Result<std::shared_ptr<const BlockHeights>> block_of(const ChunkId& leaf);
    Result<void> hold();
    void assemble(const View& view, const RefineOptions& options, const std::vector<ChunkRange>& ranges);
};

void ChunkMesher::Workshop::select(const ChunkId& id, const View& view, const RefineOptions& options,
                                   const std::vector<ChunkRange>& ranges) {
    if (id.level == 0) {
        if (has_data(id, terrain.frame())) selected.push_back(id);
        return;
    }
    const ChunkNode* node = chunks.node(id);
    if (node == nullptr) return;
    const ChunkBox box = node->box.exaggerated(exaggeration, node->most_H_m);
    if (options.cull && !box.is_in(view)) return;
    if (box.distance_m(view.eye().m) > ranges[static_cast<std::size_t>(id.level) - 1].until_m) {
        selected.push_back(id);
        return;
    }
    for (int i = 0; i < 4; ++i) select(id.child(i), view, options, ranges);
}

Result<std::shared_ptr<const BlockHeights>> ChunkMesher::Workshop::block_of(const ChunkId& leaf) {
    const GridPoint first = leaf.first();
    const PyramidBlock block{0, first.column / Pyramid::kBlockCells, first.row / Pyramid::kBlockCells};
    constexpr std::uint64_t kBytes =
        2 * sizeof(float) * (Pyramid::kBlockCells + 1) * (Pyramid::kBlockCells + 1);
    return blocks->get(block, kBytes, [&] { return terrain.pyramid()->read_heights(block); });
}

Result<std::shared_ptr<const PlacedChunk>> ChunkMesher::Workshop::node(const ChunkId& id) {
    const auto known = chunks.mesh(id);
    if (!known) return known.error();
    const std::uint64_t bytes =
        (*known)->vertices.size() * 36 + (*known)->triangles.size() * sizeof(IndexTriangle);
    return nodes->get(id, bytes, [&] { return Result<PlacedChunk>(placed(terrain, **known, exaggeration)); });
}

Result<std::shared_ptr<const Leaves>> ChunkMesher::Workshop::leaves_of(const ChunkId& parent) {
    const auto make = [&]() -> Result<Leaves> {
        ChunkShape shape{parent, {}, {}, 0};
        std::optional<CoarseSurface> coarse;
        if (chunks.node(parent) != nullptr) {
            const auto known = chunks.mesh(parent);
            if (!known) return known.error();
            shape.triangles = (*known)->triangles;
            for (const ChunkVertex& v : (*known)->vertices) {
                shape.posts.push_back(
                    {v.at, v.H, terrain.position(v.at.column, v.at.row, static_cast<double>(v.H), 1)});
            }
            coarse.emplace(shape);
        }
        Leaves made;
        for (int i = 0; i < 4; ++i) {
            const ChunkId leaf = parent.child(i);
            if (!has_data(leaf, terrain.frame())) continue;
            const auto block = block_of(leaf);
            if (!block) return block.error();
            made[static_cast<std::size_t>(i)] =
                placed(terrain, leaf_mesh(terrain, leaf, (*block)->filled, coarse ? &*coarse : nullptr),
                       exaggeration);
        }
        return made;
    };
    constexpr std::uint64_t kLeafPosts = (ChunkId::kLeafCells + 1) * (ChunkId::kLeafCells + 1);
    return leaves->get(parent, 4 * kLeafPosts * (36 + 2 * sizeof(IndexTriangle)), make);
}

/// Finds the meshes of all that is selected.
Result<void> ChunkMesher::Workshop::hold() {
    holding.assign(selected.size(), nullptr);
    drawn.assign(selected.size(), nullptr);
    std::vector<std::optional<Error>> errors(selected.size());
    tbb::parallel_for(std::size_t{0}, selected.size(), [&](std::size_t i) {
        const ChunkId& id = selected[i];
        if (id.level > 0) {
            auto found = node(id);
            if (!found) {
                errors[i] = found.error();
                return;
            }
            drawn[i] = found->get();
            holding[i] = *std::move(found);
            return;
        }
        auto found = leaves_of(id.parent());
        if (!found) {
            errors[i] = found.error();
            return;
        }
        drawn[i] = &(**found)[static_cast<std::size_t>((id.column & 1) + 2 * (id.row & 1))];
        holding[i] = *std::move(found);
    });
    for (const auto& error : errors) {
        if (error) return *error;
    }
    return {};
}

void ChunkMesher::Workshop::assemble(const View& view, const RefineOptions& options,
                                     const std::vector<ChunkRange>& ranges) {
    const std::set<ChunkId> here(selected.begin(), selected.end());
    std::vector<std::size_t> first_vertex(selected.size() + 1);
    std::vector<std::size_t> first_triangle(selected.size() + 1);
    std::vector<std::array<bool, kSides>> closes(selected.size());
    for (std::size_t i = 0; i < selected.size(); ++i) {
        std::size_t triangles = drawn[i]->triangles.size();
        for (std::size_t side = 0; side < kSides; ++side) {
            closes[i][side] = here.contains(beside(selected[i], static_cast<Side>(side)).parent());
            if (!closes[i][side]) continue;
            for (const SideVertex& vertex : drawn[i]->sides[side]) triangles += vertex.kept ? 0 : 1;
        }
        first_vertex[i + 1] = first_vertex[i] + drawn[i]->positions.size();
        first_triangle[i + 1] = first_triangle[i] + triangles;
    }
    mesh.vertices.resize(first_vertex.back());
    mesh.indices.resize(3 * first_triangle.back());
    const glm::dvec3 eye = view.eye().m;
    tbb::parallel_for(std::size_t{0}, selected.size(), [&](std::size_t i) {
        const PlacedChunk& chunk = *drawn[i];
        const ChunkRange& range = ranges[static_cast<std::size_t>(selected[i].level)];
        MeshVertex* vertex = mesh.vertices.data() + first_vertex[i];
        for (std::size_t v = 0; v < chunk.positions.size(); ++v, ++vertex) {
            glm::dvec3 offset = chunk.positions[v] - eye;
            if (options.morph && chunk.rise_m[v] != 0) {
                const double t = std::clamp(
                    (glm::length(offset) - range.morph_from_m) / (range.until_m - range.morph_from_m), 0.0,
                    1.0);
                if (t > 0) {
                    constexpr double kAxes2 = 1 - 6.69437999014e-3;
                    const glm::dvec3 up = glm::normalize(chunk.positions[v] / glm::dvec3(1, 1, kAxes2));
                    offset += (t * static_cast<double>(chunk.rise_m[v])) * up;
                }
            }
            *vertex = {static_cast<float>(offset.x), static_cast<float>(offset.y),
                       static_cast<float>(offset.z), static_cast<std::uint16_t>(chunk.posts[v].column),
                       static_cast<std::uint16_t>(chunk.posts[v].row)};
        }
        const auto base = static_cast<std::uint32_t>(first_vertex[i]);
        std::uint32_t* index = mesh.indices.data() + 3 * first_triangle[i];
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            *index++ = base + a;
            *index++ = base + b;
            *index++ = base + c;
        };
        for (const auto& [a, b, c] : chunk.triangles) add(a, b, c);
        for (std::size_t side = 0; side < kSides; ++side) {
            if (!closes[i][side]) continue;
            // Between two posts that the coarser neighbour has too, a fan from the first of them.
            std::uint32_t last_kept = 0;
            std::uint32_t last = 0;
            bool open = false;
            for (const SideVertex& at : chunk.sides[side]) {
                if (open) add(last_kept, last, at.vertex);
                open = !at.kept;
                if (at.kept) last_kept = at.vertex;
                last = at.vertex;
            }
        }
    });
}

ChunkMesher::ChunkMesher(const Terrain& terrain, const ChunkSet& chunks)
    : workshop_(std::make_unique<Workshop>(terrain, chunks)) {}
ChunkMesher::~ChunkMesher() = default;

int ChunkMesher::drawn() const {
    return static_cast<int>(workshop_->selected.size());
}

Result<const Mesh*> ChunkMesher::mesh(const View& view, const RefineOptions& options) {
    Workshop& shop = *workshop_;
    if (shop.exaggeration != options.exaggeration) {
        shop.exaggeration = options.exaggeration;
        shop.forget();
    }
    const std::vector<ChunkRange> ranges = chunk_ranges(shop.chunks.levels(), view, options);
    shop.selected.clear();
    const int top = std::max(top_chunk_level(shop.terrain.frame()), 0);
    shop.select({top, 0, 0}, view, options, ranges);
    if (auto done = shop.hold(); !done) return done.error();
    shop.assemble(view, options, ranges);
    return &shop.mesh;
}

}  // namespace relevo::lod
