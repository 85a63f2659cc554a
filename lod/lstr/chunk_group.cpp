#include "lod/lstr/chunk_group.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lod/lstr/chunk_shape.hpp"
#include "lod/lstr/triangle_order.hpp"
#include "lod/soar/cell.hpp"

namespace relevo::lod {

namespace {

/// All cells of a node of so many a side.
std::vector<IndexTriangle> cell_mesh(int cells) {
    std::vector<IndexTriangle> triangles;
    const auto index = [&](const GridPoint& p) {
        return static_cast<std::uint32_t>(p.row * (cells + 1) + p.column);
    };
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            for (const CellTriangle& t : cell_triangles({column, row}))
                triangles.push_back({index(t[0]), index(t[1]), index(t[2])});
        }
    }
    return cache_order(std::move(triangles), static_cast<std::size_t>((cells + 1) * (cells + 1)));
}

/// The sphere around a box in the fixed frame, and what it moves.
void enclose(const FixedFrame& frame, PlacedChunk& chunk) {
    glm::ivec3 low(std::numeric_limits<int>::max());
    glm::ivec3 high(std::numeric_limits<int>::min());
    float rise_m = 0;
    for (const PlacedChunk::Vertex& vertex : chunk.vertices) {
        low = glm::min(low, vertex.at);
        high = glm::max(high, vertex.at);
        rise_m = std::max(rise_m, std::abs(vertex.rise_m));
    }
    chunk.middle = 0.5 * (frame.place(low) + frame.place(high));
    chunk.radius_m = 0.5 * glm::distance(frame.place(low), frame.place(high)) + static_cast<double>(rise_m);
}

constexpr std::uint64_t kBlockBytes =
    2 * sizeof(float) * (Pyramid::kBlockCells + 1) * (Pyramid::kBlockCells + 1);

}  // namespace

bool PlacedChunk::is_in(const View& view) const {
    const glm::dvec3 offset = middle - view.eye().m;
    return std::all_of(view.side_planes().begin(), view.side_planes().end(),
                       [&](const glm::dvec3& plane) { return glm::dot(plane, offset) <= radius_m; });
}

double PlacedChunk::distance_m(const glm::dvec3& eye) const {
    return std::max(glm::distance(middle, eye) - radius_m, 0.0);
}

ChunkGroups::ChunkGroups(const Terrain& terrain, const ChunkSet& chunks, double exaggeration)
    : terrain_(terrain),
      chunks_(chunks),
      exaggeration_(exaggeration),
      frame_(FixedFrame::of(terrain, exaggeration)),
      leaf_triangles_(std::make_shared<const std::vector<IndexTriangle>>(cell_mesh(ChunkId::kLeafCells))),
      blocks_(64 * kBlockBytes) {}

void ChunkGroups::add(PlacedChunk& chunk, const ChunkVertex& vertex) const {
    const glm::dvec3 at =
        terrain_.position(vertex.at.column, vertex.at.row, static_cast<double>(vertex.H), exaggeration_);
    const double rise_m =
        exaggeration_ * (static_cast<double>(vertex.coarse_H) - static_cast<double>(vertex.H));
    chunk.vertices.push_back({frame_.fixed(at), static_cast<float>(rise_m),
                              static_cast<std::uint16_t>(vertex.at.column),
                              static_cast<std::uint16_t>(vertex.at.row)});
}

PlacedChunk ChunkGroups::placed(const ChunkMesh& mesh) const {
    PlacedChunk made;
    made.triangles = std::make_shared<const std::vector<IndexTriangle>>(mesh.triangles);
    made.sides = mesh.sides;
    made.seams = seam_edges(mesh.triangles, mesh.sides);
    made.vertices.reserve(mesh.vertices.size());
    for (const ChunkVertex& vertex : mesh.vertices) add(made, vertex);
    enclose(frame_, made);
    return made;
}

PlacedChunk ChunkGroups::leaf(const ChunkId& id, const Raster<float>& block,
                              const CoarseSurface* coarse) const {
    PlacedChunk made;
    const GridPoint first = id.first();
    const int cells = std::min(id.cells(), block.columns() - 1);
    const int in_block = Pyramid::kBlockCells - 1;
    made.triangles = cells == ChunkId::kLeafCells
                         ? leaf_triangles_
                         : std::make_shared<const std::vector<IndexTriangle>>(cell_mesh(cells));
    made.vertices.reserve(static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 1));
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const GridPoint at{first.column + column, first.row + row};
            const float H = block.at((first.column & in_block) + column, (first.row & in_block) + row);
            ChunkVertex vertex{at, H, H};
            bool kept = true;
            if (coarse != nullptr) {
                vertex.coarse_H =
                    coarse->height({at, H, terrain_.position(at.column, at.row, static_cast<double>(H), 1)});
                kept = coarse->has(at);
            }
            const SideVertex on_side{static_cast<std::uint32_t>(made.vertices.size()), kept};
            if (column == 0) made.sides[static_cast<std::size_t>(Side::west)].push_back(on_side);
            if (column == cells) made.sides[static_cast<std::size_t>(Side::east)].push_back(on_side);
            if (row == 0) made.sides[static_cast<std::size_t>(Side::north)].push_back(on_side);
            if (row == cells) made.sides[static_cast<std::size_t>(Side::south)].push_back(on_side);
            add(made, vertex);
        }
    }
    enclose(frame_, made);
    return made;
}

Result<ChunkGroup> ChunkGroups::leaves(const ChunkId& parent) const {
    ChunkShape shape{parent, {}, {}, 0};
    std::optional<CoarseSurface> coarse;
    if (chunks_.node(parent) != nullptr) {
        const auto known = chunks_.mesh(parent);
        if (!known) return known.error();
        shape.triangles = (*known)->triangles;
        for (const ChunkVertex& v : (*known)->vertices) {
            shape.posts.push_back(
                {v.at, v.H, terrain_.position(v.at.column, v.at.row, static_cast<double>(v.H), 1)});
        }
        coarse.emplace(shape);
    }
    ChunkGroup made;
    for (int i = 0; i < 4; ++i) {
        const ChunkId id = parent.child(i);
        if (!has_data(id, terrain_.frame())) continue;
        const GridPoint first = id.first();
        const PyramidBlock at{0, first.column / Pyramid::kBlockCells, first.row / Pyramid::kBlockCells};
        const auto block = blocks_.get(at, kBlockBytes, [&] { return terrain_.pyramid()->read_heights(at); });
        if (!block) return block.error();
        made.children[static_cast<std::size_t>(i)] = leaf(id, (*block)->filled, coarse ? &*coarse : nullptr);
    }
    return made;
}

Result<ChunkGroup> ChunkGroups::load(const ChunkId& parent) const {
    ChunkGroup made;
    if (parent.level == 1) {
        auto read = leaves(parent);
        if (!read) return read.error();
        made = *std::move(read);
    } else {
        for (int i = 0; i < 4; ++i) {
            const ChunkId id = parent.child(i);
            if (chunks_.node(id) == nullptr) continue;
            const auto known = chunks_.mesh(id);
            if (!known) return known.error();
            made.children[static_cast<std::size_t>(i)] = placed(**known);
        }
    }
    for (const PlacedChunk& child : made.children) {
        made.bytes += sizeof(PlacedChunk) + child.vertices.size() * sizeof(PlacedChunk::Vertex);
        for (const auto& side : child.sides) made.bytes += side.size() * sizeof(SideVertex);
        made.bytes += child.seams.size() * sizeof(SeamEdge);
        if (child.triangles && child.triangles != leaf_triangles_)
            made.bytes += child.triangles->size() * sizeof(IndexTriangle);
    }
    return made;
}

std::uint64_t ChunkGroups::bytes(const ChunkId& parent) const {
    std::uint64_t bytes = 4 * sizeof(PlacedChunk);
    constexpr std::uint64_t kLeafSide = ChunkId::kLeafCells + 1;
    for (int i = 0; i < 4; ++i) {
        if (parent.level == 1) {
            bytes += kLeafSide * kLeafSide * sizeof(PlacedChunk::Vertex);
        } else if (const ChunkNode* node = chunks_.node(parent.child(i))) {
            bytes += node->vertices * (sizeof(PlacedChunk::Vertex) + 2 * sizeof(IndexTriangle));
        }
    }
    return bytes;
}

}  // namespace relevo::lod
