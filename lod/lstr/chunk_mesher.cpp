#include "lod/lstr/chunk_mesher.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "lod/lstr/chunk_group.hpp"
#include "lod/lstr/finer_sides.hpp"

namespace relevo::lod {

struct ChunkMesher::Workshop {
    const Terrain& terrain;
    const ChunkSet& chunks;
    ChunkOptions options;
    ChunkSelector selector;
    Mesh mesh;
    int drawn = 0;
    double exaggeration = 0;              // of the places in the store
    std::uint64_t edition = 0;            // likewise
    std::unique_ptr<ChunkGroups> groups;  // the store uses it
    std::unique_ptr<ChunkStore> store;

    Workshop(const Terrain& of, const ChunkSet& set, const ChunkOptions& asked)
        : terrain(of), chunks(set), options(asked), selector(set, of.frame()) {}

    Result<void> prepare(const RefineOptions& refine);
    ChunkPicture picture(const std::vector<SelectedChunk>& selected);
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
        static std::atomic<std::uint64_t> editions = 0;
        edition = ++editions;
    }
    return {};
}

ChunkPicture ChunkMesher::Workshop::picture(const std::vector<SelectedChunk>& selected) {
    ChunkPicture made{&selected, groups->frame(), edition, 0, 0};
    for (const SelectedChunk& node : selected) {
        const std::size_t finer = count_finer(node);
        made.triangles += node.chunk->triangles->size() + finer;
        made.vertices += node.chunk->vertices.size() + finer;
    }
    drawn = static_cast<int>(selected.size());
    return made;
}

namespace {

glm::dvec3 up_at(const glm::dvec3& ecef) {
    constexpr double kAxes2 = 1 - 6.69437999014e-3;  // (polar radius / equatorial radius)^2
    return glm::normalize(ecef / glm::dvec3(1, 1, kAxes2));
}

}  // namespace

void ChunkMesher::Workshop::assemble(const View& view, const std::vector<SelectedChunk>& selected) {
    std::vector<std::size_t> first_vertex(selected.size() + 1);
    std::vector<std::size_t> first_triangle(selected.size() + 1);
    for (std::size_t i = 0; i < selected.size(); ++i) {
        const std::size_t finer = count_finer(selected[i]);
        first_vertex[i + 1] = first_vertex[i] + selected[i].chunk->vertices.size() + finer;
        first_triangle[i + 1] = first_triangle[i] + selected[i].chunk->triangles->size() + finer;
    }
    mesh.vertices.resize(first_vertex.back());
    mesh.indices.resize(3 * first_triangle.back());
    const FixedFrame& frame = groups->frame();
    const glm::dvec3 to_origin = frame.origin - view.eye().m;
    tbb::parallel_for(std::size_t{0}, selected.size(), [&](std::size_t i) {
        const SelectedChunk& node = selected[i];
        const PlacedChunk& chunk = *node.chunk;
        MeshVertex* const vertices = mesh.vertices.data() + first_vertex[i];
        const auto place = [&](const PlacedChunk::Vertex& vertex, double moved) -> MeshVertex {
            glm::dvec3 offset = to_origin + frame.unit_m * glm::dvec3(vertex.at);
            if (moved > 0 && vertex.rise_m != 0)
                offset += (moved * static_cast<double>(vertex.rise_m)) * up_at(frame.place(vertex.at));
            return {static_cast<float>(offset.x), static_cast<float>(offset.y), static_cast<float>(offset.z),
                    vertex.column, vertex.row};
        };
        for (std::size_t v = 0; v < chunk.vertices.size(); ++v)
            vertices[v] = place(chunk.vertices[v], node.moved);
        for (std::size_t side = 0; side < kSides; ++side) {
            if (node.moved_on_side[side] == node.moved) continue;
            for (const SideVertex& on : chunk.sides[side])
                vertices[on.vertex] = place(chunk.vertices[on.vertex], node.moved_on_side[side]);
        }
        const FinerSides finer = finer_sides(node);
        std::transform(finer.vertices.begin(), finer.vertices.end(), vertices + chunk.vertices.size(),
                       [&](const PlacedChunk::Vertex& vertex) { return place(vertex, 1); });
        write_triangles(node, finer.seams, static_cast<std::uint32_t>(first_vertex[i]),
                        mesh.indices.data() + 3 * first_triangle[i]);
    });
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

Result<ChunkPicture> ChunkMesher::picture(const View& view, const RefineOptions& options) {
    Workshop& shop = *workshop_;
    if (auto done = shop.prepare(options); !done) return done.error();
    const SelectionOptions& selection = shop.options.selection;
    shop.store->start_frame(shop.selector.wish(view, options, selection));
    return shop.picture(shop.selector.select(view, options, selection, *shop.store));
}

Result<ChunkPicture> ChunkMesher::whole_picture(const View& view, const RefineOptions& options) {
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
    return shop.picture(shop.selector.select(view, options, selection, *shop.store));
}

const Mesh& ChunkMesher::assemble(const View& view, const ChunkPicture& picture) {
    workshop_->assemble(view, *picture.nodes);
    return workshop_->mesh;
}

}  // namespace relevo::lod
