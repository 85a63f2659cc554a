#include "lod/lstr/chunk_builder.hpp"

#include <atomic>
#include <memory>
#include <utility>

#include <tbb/parallel_pipeline.h>

#include "lod/lstr/chunk_simplifier.hpp"
#include "lod/lstr/empty_shape.hpp"
#include "lod/lstr/mesh_error.hpp"

namespace relevo::lod {

namespace {

/// The filter's margin, of what level 1 may be off: what it finds is taken away one by one, and more than
/// once beside each other.
constexpr double kFilterPart = 0.25;

}  // namespace

ChunkShape ChunkBuilder::build_in(const PostField& field, const PostSet& removable, const ChunkId& id,
                                  const Sink& sink, std::vector<Writing>& done) const {
    if (!has_data(id, terrain_.frame())) return empty_shape(field, id, building_.errors);
    if (id.level == 1) {
        ChunkShape shape = finest_shape(field, id, building_.errors, removable);
        shape.error_m = error_in(field, shape);
        return shape;
    }
    std::array<ChunkShape, 4> children;
    for (int i = 0; i < 4; ++i)
        children[static_cast<std::size_t>(i)] = build_in(field, removable, id.child(i), sink, done);
    ChunkShape shape = coarser_shape(field, id, building_.errors, children);
    shape.error_m = error_in(field, shape);
    const CoarseSurface coarse(shape);
    for (const ChunkShape& child : children) {
        if (!has_data(child.id, terrain_.frame())) continue;
        ChunkMesh mesh = finished(child, &coarse);
        mesh.moved_error_m = error_in(field, moved(terrain_, child, coarse));
        done.push_back(sink(mesh));
    }
    return shape;
}

/// What can be done before a node's turn comes: itself, and what the nodes below it are written with.
struct ChunkBuilder::Piece {
    ChunkShape top;
    std::vector<Writing> below;
};

/// What is done in turn, by the quadtree's order: a node of the pieces' level, or a subtree that is there
/// already.
struct ChunkBuilder::Step {
    ChunkId id;
    std::optional<ChunkShape> known;
};

Result<void> ChunkBuilder::plan(const ChunkId& id, const Subtrees& subtrees, std::vector<Step>& steps) const {
    if (id.level <= building_.piece_level) {
        steps.push_back({id, std::nullopt});
        return {};
    }
    if (subtrees.find && has_data(id, terrain_.frame())) {
        const auto known = subtrees.find(id);
        if (!known) return known.error();
        if (*known) {
            steps.push_back({id, shape_of(terrain_, **known)});
            return {};
        }
    }
    for (int i = 0; i < 4; ++i) {
        if (auto done = plan(id.child(i), subtrees, steps); !done) return done;
    }
    return {};
}

Result<ChunkBuilder::Piece> ChunkBuilder::build_piece(const ChunkId& id, const Sink& sink) const {
    const bool judges = has_data(id, terrain_.frame());
    const auto field = PostField::read(terrain_, id.first(), id.cells(), 1, judges);
    if (!field) return field.error();
    Piece piece;
    const auto margin_m = static_cast<float>(kFilterPart * building_.errors.first_m);
    const PostSet removable = removable_posts(field->heights(), margin_m, building_.filter);
    piece.top = build_in(*field, removable, id, sink, piece.below);
    return piece;
}

Result<ChunkShape> ChunkBuilder::build_above(const ChunkId& id, const std::array<ChunkShape, 4>& children,
                                             const Sink& sink) const {
    const auto field =
        PostField::read(terrain_, id.first(), id.cells(), 1 << (id.level - building_.piece_level));
    if (!field) return field.error();
    ChunkShape shape = coarser_shape(*field, id, building_.errors, children);
    const CoarseSurface coarse(shape);
    std::vector<ChunkShape> shapes{shape};
    for (const ChunkShape& child : children) shapes.push_back(moved(terrain_, child, coarse));
    const auto errors = errors_in(terrain_, id, shapes);
    if (!errors) return errors.error();
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (!has_data(children[i].id, terrain_.frame())) continue;
        ChunkMesh mesh = finished(children[i], &coarse);
        mesh.moved_error_m = (*errors)[i + 1];
        if (auto done = sink(mesh)(); !done) return done.error();
    }
    shape.error_m = errors->front();
    return shape;
}

Result<void> ChunkBuilder::build(const Sink& sink, const Subtrees& subtrees) const {
    const int top = top_chunk_level(terrain_.frame());
    if (top < 1) return {};
    std::vector<Step> steps;
    if (auto done = plan({top, 0, 0}, subtrees, steps); !done) return done;

    std::vector<ChunkShape> open;  // nodes whose parents are not built yet, by the quadtree's order
    const auto add = [&](Piece piece) -> Result<void> {
        for (const Writing& write : piece.below) {
            if (auto done = write(); !done) return done;
        }
        open.push_back(std::move(piece.top));
        while (open.back().id.level < top && open.back().id == open.back().id.parent().child(3)) {
            const ChunkId id = open.back().id.parent();
            std::array<ChunkShape, 4> children;
            std::move(open.end() - 4, open.end(), children.begin());
            open.resize(open.size() - 4);
            auto built = build_above(id, children, sink);
            if (!built) return built.error();
            open.push_back(*std::move(built));
            if (!subtrees.keep || !has_data(id, terrain_.frame())) continue;
            if (auto done = subtrees.keep(finished(open.back(), nullptr)); !done) return done;
        }
        return {};
    };

    // Pieces are built ahead while what is above those before them is.
    std::size_t next = 0;
    std::atomic<bool> has_failed = false;
    Result<void> state;
    using Built = std::shared_ptr<Result<Piece>>;
    const auto take_next = [&](tbb::flow_control& control) -> Step* {
        if (next < steps.size() && !has_failed) return &steps[next++];
        control.stop();
        return nullptr;
    };
    const auto build_next = [&](Step* step) -> Built {
        if (step->known) return std::make_shared<Result<Piece>>(Piece{*std::move(step->known), {}});
        return std::make_shared<Result<Piece>>(build_piece(step->id, sink));
    };
    const auto add_built = [&](const Built& built) {
        if (has_failed) return;
        state = *built ? add(std::move(**built)) : built->error();
        has_failed = !state;
    };
    constexpr auto kInTurn = tbb::filter_mode::serial_in_order;
    tbb::parallel_pipeline(kPiecesAhead,
                           tbb::make_filter<void, Step*>(kInTurn, take_next) &
                               tbb::make_filter<Step*, Built>(tbb::filter_mode::parallel, build_next) &
                               tbb::make_filter<Built, void>(kInTurn, add_built));
    if (!state) return state;
    return sink(finished(open.front(), nullptr))();
}

}  // namespace relevo::lod
