#include "lod/lstr/chunk_mesher.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "lod/lstr/chunk_group.hpp"

namespace relevo::lod {

struct ChunkMesher::Workshop {
    const Terrain& terrain;
    const ChunkSet& chunks;
    ChunkOptions options;
    ChunkSelector selector;
    Mesh mesh;
    int drawn = 0;
    double exaggeration = 0;              // of the places in the store
    std::unique_ptr<ChunkGroups> groups;  // the store uses it
    std::unique_ptr<ChunkStore> store;

    Workshop(const Terrain& of, const ChunkSet& set, const ChunkOptions& asked)
        : terrain(of), chunks(set), options(asked), selector(set, of.frame()) {}

    Result<void> prepare(const RefineOptions& refine);
    void assemble(const View& view, const std::vector<SelectedChunk>& selected);
};

/// Makes the store for an exaggeration.
Result<void> ChunkMesher::Workshop::prepare(const RefineOptions& refine) {
    if (!store || exaggeration != refine.exaggeration) {
        store.reset();
        groups = std::make_unique<ChunkGroups>(terrain, chunks, refine.exaggeration);
        const ChunkId above_root{std::max(top_chunk_level(terrain.frame()), 0) + 1, 0, 0};
        auto opened = ChunkStore::open(*groups, above_root, options.store);
        if (!opened) return opened.error();
        store = *std::move(opened);
        exaggeration = refine.exaggeration;
    }
    return {};
}

namespace {

/// Vertices of a mesh from which on other cores are woken: they cost about 30 us, as long as this many take.
constexpr std::size_t kWorthSharing = 4096;

glm::dvec3 up_at(const glm::dvec3& ecef) {
    constexpr double kAxes2 = 1 - 6.69437999014e-3;  // (polar radius / equatorial radius)^2
    return glm::normalize(ecef / glm::dvec3(1, 1, kAxes2));
}

/// Triangles that close a side: between two posts that the coarser neighbour has too, a fan from the first of
/// them. Calls add(a, b, c).
template <class Add>
void close_side(const std::vector<SideVertex>& side, const Add& add) {
    std::uint32_t last_kept = 0;
    std::uint32_t last = 0;
    bool open = false;
    for (const SideVertex& at : side) {
        if (open) add(last_kept, last, at.vertex);
        open = !at.kept;
        if (at.kept) last_kept = at.vertex;
        last = at.vertex;
    }
}

}  // namespace

void ChunkMesher::Workshop::assemble(const View& view, const std::vector<SelectedChunk>& selected) {
    std::vector<std::size_t> first_vertex(selected.size() + 1);
    std::vector<std::size_t> first_triangle(selected.size() + 1);
    for (std::size_t i = 0; i < selected.size(); ++i) {
        std::size_t triangles = selected[i].chunk->triangles->size();
        for (std::size_t side = 0; side < kSides; ++side) {
            if (!selected[i].closes[side]) continue;
            for (const SideVertex& vertex : selected[i].chunk->sides[side]) triangles += vertex.kept ? 0 : 1;
        }
        first_vertex[i + 1] = first_vertex[i] + selected[i].chunk->vertices.size();
        first_triangle[i + 1] = first_triangle[i] + triangles;
    }
    mesh.vertices.resize(first_vertex.back());
    mesh.indices.resize(3 * first_triangle.back());
    const FixedFrame& frame = groups->frame();
    const glm::dvec3 to_origin = frame.origin - view.eye().m;
    const auto assemble_node = [&](std::size_t i) {
        const SelectedChunk& node = selected[i];
        const PlacedChunk& chunk = *node.chunk;
        MeshVertex* vertices = mesh.vertices.data() + first_vertex[i];
        const auto place = [&](std::size_t v, double moved) {
            const PlacedChunk::Vertex& vertex = chunk.vertices[v];
            glm::dvec3 offset = to_origin + frame.unit_m * glm::dvec3(vertex.at);
            if (moved > 0 && vertex.rise_m != 0)
                offset += (moved * static_cast<double>(vertex.rise_m)) * up_at(frame.place(vertex.at));
            vertices[v] = {static_cast<float>(offset.x), static_cast<float>(offset.y),
                           static_cast<float>(offset.z), vertex.column, vertex.row};
        };
        for (std::size_t v = 0; v < chunk.vertices.size(); ++v) place(v, node.moved);
        for (std::size_t side = 0; side < kSides; ++side) {
            if (node.moved_on_side[side] == node.moved) continue;
            for (const SideVertex& vertex : chunk.sides[side]) place(vertex.vertex, node.moved_on_side[side]);
        }
        const auto base = static_cast<std::uint32_t>(first_vertex[i]);
        std::uint32_t* index = mesh.indices.data() + 3 * first_triangle[i];
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            *index++ = base + a;
            *index++ = base + b;
            *index++ = base + c;
        };
        for (const auto& [a, b, c] : *chunk.triangles) add(a, b, c);
        for (std::size_t side = 0; side < kSides; ++side) {
            if (node.closes[side]) close_side(chunk.sides[side], add);
        }
    };
    if (first_vertex.back() < kWorthSharing) {
        for (std::size_t i = 0; i < selected.size(); ++i) assemble_node(i);
    } else {
        tbb::parallel_for(std::size_t{0}, selected.size(), assemble_node);
    }
    drawn = static_cast<int>(selected.size());
}

ChunkMesher::ChunkMesher(const Terrain& terrain, const ChunkSet& chunks, const ChunkOptions& options)
    : workshop_(std::make_unique<Workshop>(terrain, chunks, options)) {}
ChunkMesher::~ChunkMesher() = default;

SelectionOptions& ChunkMesher::selection() {
    return workshop_->options.selection;
}

ChunkMesher::Figures ChunkMesher::figures() const {
    Figures figures{workshop_->drawn, workshop_->selector.is_fading(), {}};
    if (workshop_->store) figures.store = workshop_->store->figures();
    return figures;
}

std::optional<Error> ChunkMesher::failure() const {
    return workshop_->store ? workshop_->store->failure() : std::nullopt;
}

Result<const Mesh*> ChunkMesher::mesh(const View& view, const RefineOptions& options) {
    Workshop& shop = *workshop_;
    if (auto done = shop.prepare(options); !done) return done.error();
    const SelectionOptions& selection = shop.options.selection;
    shop.store->start_frame(shop.selector.wish(view, options, selection));
    shop.assemble(view, shop.selector.select(view, options, selection, *shop.store));
    return &shop.mesh;
}

Result<const Mesh*> ChunkMesher::whole_mesh(const View& view, const RefineOptions& options) {
    Workshop& shop = *workshop_;
    if (auto done = shop.prepare(options); !done) return done.error();
    SelectionOptions selection = shop.options.selection;
    selection.swap_factor = 1;
    selection.fade_s = 0;
    const std::vector<ChunkWish>& wishes = shop.selector.wish(view, options, selection);
    shop.store->start_frame(wishes);
    std::vector<ChunkId> missing;
    for (const ChunkWish& wish : wishes) {
        if (wish.now && shop.store->find(wish.parent) == nullptr) missing.push_back(wish.parent);
    }
    if (auto done = shop.store->load(missing); !done) return done.error();
    shop.assemble(view, shop.selector.select(view, options, selection, *shop.store));
    return &shop.mesh;
}

}  // namespace relevo::lod
