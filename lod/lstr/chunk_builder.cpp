#include "lod/lstr/chunk_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include "lod/lstr/border_line.hpp"
#include "lod/lstr/mesh_error.hpp"
#include "lod/soar/cell.hpp"
#include "lod/static_mesh/grid_triangle.hpp"

namespace relevo::lod {

namespace {

/// Of a level's error, what its borders may be off: the rest is for what lies between them.
constexpr double kBorderPart = 0.5;

bool is_before(const PlacedPost& a, const PlacedPost& b) {
    return std::tie(a.at.row, a.at.column) < std::tie(b.at.row, b.at.column);
}

/// Of a post in a list that is row by row.
std::uint32_t place_of(const std::vector<PlacedPost>& posts, const PlacedPost& post) {
    return static_cast<std::uint32_t>(std::lower_bound(posts.begin(), posts.end(), post, is_before) -
                                      posts.begin());
}

/// The meshes of four children as one.
PlanarMesh joined(const ChunkId& id, const std::array<ChunkShape, 4>& children) {
    std::vector<PlacedPost> posts;
    for (const ChunkShape& child : children)
        posts.insert(posts.end(), child.posts.begin(), child.posts.end());
    std::sort(posts.begin(), posts.end(), is_before);
    posts.erase(std::unique(posts.begin(), posts.end(),
                            [](const PlacedPost& a, const PlacedPost& b) { return a.at == b.at; }),
                posts.end());
    std::vector<IndexTriangle> triangles;
    for (const ChunkShape& child : children) {
        std::vector<std::uint32_t> place(child.posts.size());
        for (std::size_t v = 0; v < place.size(); ++v) place[v] = place_of(posts, child.posts[v]);
        for (const auto& [a, b, c] : child.triangles) triangles.push_back({place[a], place[b], place[c]});
    }
    return {std::move(posts), triangles, id.first(), id.cells()};
}

/// Largest error of what a plan puts in a vertex's place, or some error above the limit.
double error_of(const PostField& field, const PlanarMesh& mesh, std::uint32_t vertex,
                const PlanarMesh::Plan& plan, double limit_m) {
    // Most of what is too far off is so where the vertex was.
    const PlacedPost& taken = mesh.post(vertex);
    double error = 0;
    for (const IndexTriangle& t : plan.triangles) {
        const PlacedTriangle placed = mesh.placed(plan, t);
        bool holds = true;
        for (std::size_t i = 0; i < 3; ++i)
            holds = holds && turn(placed[i]->at, placed[(i + 1) % 3]->at, taken.at) >= 0;
        if (!holds) continue;
        error = error_at(taken, placed);
        break;
    }
    if (error > limit_m) return error;
    for (const IndexTriangle& t : plan.triangles) {
        const PlacedTriangle placed = mesh.placed(plan, t);
        error = std::max(error, field.error(placed, limit_m));
        for (std::size_t i = 0; i < 3 && error <= limit_m; ++i) {
            // New edges alone, and each of them once.
            const std::uint32_t next = t[(i + 1) % 3];
            if (t[i] < next && mesh.is_inner(plan, t[i], next))
                error = std::max(error, field.edge_error(*placed[i], *placed[(i + 1) % 3], limit_m));
        }
        if (error > limit_m) break;
    }
    return error;
}

/// Of the ways to fill a vertex's place the first that is good enough, or the one with the least error; false
/// where there is none. Of what is worse than the limit it is only known that it is off by at least
/// `error_m`.
bool best_plan(const PostField& field, const PlanarMesh& mesh, std::uint32_t vertex, double enough_m,
               double limit_m, PlanarMesh::Plan& best, double& error_m) {
    bool any = mesh.plan(vertex, best);
    error_m = any ? error_of(field, mesh, vertex, best, limit_m) : INFINITY;
    if (error_m <= enough_m) return true;
    PlanarMesh::Plan fan = best;
    for (std::uint32_t corner = 0; corner < fan.polygon.size(); ++corner) {
        if (!mesh.plan_fan(corner, fan)) continue;
        const double error = error_of(field, mesh, vertex, fan, std::min(error_m, limit_m));
        if (any && error >= error_m) continue;
        any = true;
        error_m = error;
        std::swap(best.triangles, fan.triangles);
    }
    return any;
}

/// Takes the posts off the sides that the level does not keep.
void thin_border(const PostField& field, const ChunkId& id, double error_m, PlanarMesh& mesh) {
    const GridPoint first = id.first();
    for (int side = 0; side < kSides; ++side) {
        const bool along_row = side >= 2;
        const int line = (along_row ? first.row : first.column) + (side % 2 == 1 ? id.cells() : 0);
        std::vector<std::uint32_t> vertices;
        std::vector<const PlacedPost*> posts;
        for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
            const GridPoint& at = mesh.post(v).at;
            if ((along_row ? at.row : at.column) != line) continue;
            vertices.push_back(v);
            posts.push_back(&mesh.post(v));
        }
        const std::vector<bool> kept = border_line(field, posts, error_m);
        PlanarMesh::Plan plan;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            double error = 0;
            if (!kept[i] && best_plan(field, mesh, vertices[i], error_m, INFINITY, plan, error))
                mesh.take(vertices[i], plan);
        }
    }
}

/// Of a triangle and its edges, or some error greater than the limit.
double error_of(const PostField& field, const PlacedTriangle& t, double limit_m) {
    double error = field.error(t, limit_m);
    for (std::size_t i = 0; i < 3 && error <= limit_m; ++i)
        error = std::max(error, field.edge_error(*t[i], *t[(i + 1) % 3], limit_m));
    return error;
}

PlacedTriangle placed(const PlanarMesh& mesh, const IndexTriangle& t) {
    return {&mesh.post(t[0]), &mesh.post(t[1]), &mesh.post(t[2])};
}

/// Puts posts inside, the one that is farthest off first, until none is off by more than the limit.
void insert_posts(const PostField& field, const ChunkId& id, double limit_m, PlanarMesh& mesh) {
    struct Open {
        double error_m;
        GridPoint at;
        IndexTriangle triangle;
        bool operator<(const Open& other) const {
            return std::tie(error_m, other.at.row, other.at.column) <
                   std::tie(other.error_m, at.row, at.column);
        }
    };
    std::priority_queue<Open> open;
    const auto judge = [&](const IndexTriangle& t) {
        const PlacedTriangle corners = placed(mesh, t);
        if (field.error(corners, limit_m) <= limit_m) return;
        const PostField::Worst worst = field.worst(corners, id.first(), id.cells());
        if (worst.error_m > limit_m) open.push({worst.error_m, worst.at, t});
    };
    for (const IndexTriangle& t : mesh.triangles()) judge(t);
    while (!open.empty()) {
        const Open next = open.top();
        open.pop();
        if (!mesh.has(next.triangle)) continue;
        const std::uint32_t v = mesh.insert(field.post(next.at), next.triangle);
        mesh.legalize(v);
        const std::vector<std::uint32_t> ring = mesh.ring(v);
        for (std::size_t i = 0; i < ring.size(); ++i) judge({v, ring[i], ring[(i + 1) % ring.size()]});
    }
}

/// Turns edges that are farther off than the limit between posts, where that helps, and puts posts beside
/// them where it does not.
void mend_edges(const PostField& field, const ChunkId& id, double limit_m, PlanarMesh& mesh) {
    std::vector<IndexTriangle> open = mesh.triangles();
    std::size_t flips_left = 4 * open.size();
    while (!open.empty()) {
        const IndexTriangle t = open.back();
        open.pop_back();
        if (!mesh.has(t) || error_of(field, placed(mesh, t), limit_m) <= limit_m) continue;
        const PostField::Worst worst = field.worst(placed(mesh, t), id.first(), id.cells());
        if (worst.error_m > 0) {
            const std::uint32_t v = mesh.insert(field.post(worst.at), t);
            const std::vector<std::uint32_t>& ring = mesh.ring(v);
            for (std::size_t i = 0; i < ring.size(); ++i)
                open.push_back({v, ring[i], ring[(i + 1) % ring.size()]});
            continue;
        }
        for (std::size_t i = 0; i < 3 && flips_left > 0; ++i) {
            const std::uint32_t a = t[i];
            const std::uint32_t b = t[(i + 1) % 3];
            const double before = field.edge_error(mesh.post(a), mesh.post(b), INFINITY);
            if (before <= limit_m) continue;
            const auto flipped = mesh.flipped(a, b);
            if (!flipped) continue;
            const auto after = [&](std::size_t k) {
                return error_of(field, placed(mesh, (*flipped)[k]), before);
            };
            if (after(0) >= before || after(1) >= before) continue;
            --flips_left;
            mesh.flip(a, b, *flipped);
            open.insert(open.end(), flipped->begin(), flipped->end());
            break;
        }
    }
}

/// A node of which nothing is ever drawn: what its sides must have for its neighbours, and its middle.
ChunkShape empty_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors) {
    const GridPoint first = id.first();
    const int cells = id.cells();
    const auto side_of = [&](bool along_row, int line) {
        // Level by level, from all posts on.
        std::vector<PlacedPost> posts;
        for (int i = 0; i <= cells; i += field.stride()) {
            posts.push_back(
                field.post(along_row ? GridPoint{first.column + i, line} : GridPoint{line, first.row + i}));
        }
        for (int level = 1; level <= id.level; ++level) {
            std::vector<PlacedPost> coarser;
            const int step = ChunkId::kLeafCells << level;
            for (int begin = 0; begin < cells; begin += step) {
                std::vector<const PlacedPost*> part;
                for (const PlacedPost& post : posts) {
                    const int place = along_row ? post.at.column - first.column : post.at.row - first.row;
                    if (place >= begin && place <= begin + step) part.push_back(&post);
                }
                const std::vector<bool> kept = border_line(field, part, kBorderPart * errors.of_level(level));
                for (std::size_t i = begin == 0 ? 0 : 1; i < part.size(); ++i) {
                    if (kept[i]) coarser.push_back(*part[i]);
                }
            }
            posts = std::move(coarser);
        }
        return posts;
    };
    // Counter-clockwise from the north-west.
    std::vector<PlacedPost> around = side_of(false, first.column);
    const auto append = [&](std::vector<PlacedPost> posts, bool backwards) {
        if (backwards) std::reverse(posts.begin(), posts.end());
        around.insert(around.end(), posts.begin() + 1, posts.end());
    };
    append(side_of(true, first.row + cells), false);
    append(side_of(false, first.column + cells), true);
    append(side_of(true, first.row), true);
    around.pop_back();

    ChunkShape shape{id, around, {}, 0};
    shape.posts.push_back(field.post({first.column + cells / 2, first.row + cells / 2}));
    std::sort(shape.posts.begin(), shape.posts.end(), is_before);
    const auto place = [&](const PlacedPost& post) { return place_of(shape.posts, post); };
    const std::uint32_t middle = place(field.post({first.column + cells / 2, first.row + cells / 2}));
    for (std::size_t i = 0; i < around.size(); ++i)
        shape.triangles.push_back({middle, place(around[i]), place(around[(i + 1) % around.size()])});
    return shape;
}

/// Does no more than the margin set the post off from its eight neighbours in pairs?
bool is_removable(const PostField& field, const GridPoint& at, double margin_m) {
    const auto H = [&](int x, int y) { return field.height({at.column + x, at.row + y}); };
    const float E = H(0, 0);
    const auto near = [&](float a, float b) {
        return std::abs(0.5 * (static_cast<double>(a) + static_cast<double>(b)) - static_cast<double>(E)) <=
               margin_m;
    };
    return near(H(-1, -1), H(1, 1)) && near(H(0, -1), H(0, 1)) && near(H(1, -1), H(-1, 1)) &&
           near(H(1, 0), H(-1, 0));
}

}  // namespace

ChunkErrors ChunkErrors::for_spacing(double spacing_m) {
    // At 720 rows and 60 degrees a pixel of it is seen from some 95 posts away: as far as nodes are wide, so
    // that neither errors nor sizes make ranges (chunk_mesher.hpp) larger than they need be.
    constexpr double kPart = 0.15;
    return {kPart * spacing_m};
}

/// The mesh that level 1 begins with: what its sides keep, and its middle.
PlanarMesh ChunkBuilder::refined(const PostField& field, const ChunkId& id) const {
    ChunkShape shape = empty_shape(field, id, errors_);
    return {std::move(shape.posts), shape.triangles, id.first(), id.cells()};
}

/// The mesh that a coarser level begins with: its children's, with what its sides keep.
PlanarMesh ChunkBuilder::coarsened(const PostField& field, const ChunkId& id,
                                   const std::array<ChunkShape, 4>& children) const {
    PlanarMesh mesh = joined(id, children);
    thin_border(field, id, kBorderPart * errors_.of_level(id.level), mesh);
    return mesh;
}

ChunkShape ChunkBuilder::simplified(const PostField& field, const ChunkId& id, PlanarMesh mesh) const {
    const double limit_m = errors_.of_level(id.level);
    insert_posts(field, id, limit_m, mesh);
    mend_edges(field, id, limit_m, mesh);

    // By weight: what the filter finds first, then from the middle to the border.
    const GridPoint first = id.first();
    std::vector<std::pair<int, std::uint32_t>> left;
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        if (!mesh.is_alive(v) || mesh.on_border(v)) continue;
        const GridPoint& at = mesh.post(v).at;
        const int inside = std::min({at.column - first.column, first.column + id.cells() - at.column,
                                     at.row - first.row, first.row + id.cells() - at.row});
        const bool goes_first = id.level == 1 && is_removable(field, at, 0.25 * limit_m);
        left.emplace_back(goes_first ? 0 : 1 + id.cells() / 2 - inside, v);
    }
    std::sort(left.begin(), left.end());
    PlanarMesh::Plan plan;
    std::vector<double> at_least(mesh.vertices());  // what taking a vertex would cost, until its ring changes
    for (const double part : {0.25, 0.5, 0.75, 1.0, 1.0}) {
        std::erase_if(left, [&](const auto& entry) {
            const std::uint32_t v = entry.second;
            if (at_least[v] > part * limit_m) return false;
            double error = 0;
            if (!best_plan(field, mesh, v, part * limit_m, part * limit_m, plan, error) ||
                error > part * limit_m) {
                at_least[v] = error;
                return false;
            }
            mesh.take(v, plan);
            for (const std::uint32_t u : plan.polygon) at_least[u] = 0;
            return true;
        });
    }

    ChunkShape shape{id, {}, {}, 0};
    std::vector<std::uint32_t> place(mesh.vertices());
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        if (!mesh.is_alive(v)) continue;
        shape.posts.push_back(mesh.post(v));
    }
    std::sort(shape.posts.begin(), shape.posts.end(), is_before);
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        if (mesh.is_alive(v)) place[v] = place_of(shape.posts, mesh.post(v));
    }
    for (const auto& [a, b, c] : mesh.triangles()) shape.triangles.push_back({place[a], place[b], place[c]});
    return shape;
}

ChunkShape ChunkBuilder::build_in(const PostField& field, const ChunkId& id,
                                  std::vector<ChunkMesh>& done) const {
    if (!has_data(id, terrain_.frame())) return empty_shape(field, id, errors_);
    if (id.level == 1) {
        ChunkShape shape = simplified(field, id, refined(field, id));
        shape.error_m = error_in(field, shape);
        return shape;
    }
    std::array<ChunkShape, 4> children;
    for (int i = 0; i < 4; ++i) children[static_cast<std::size_t>(i)] = build_in(field, id.child(i), done);
    ChunkShape shape = simplified(field, id, coarsened(field, id, children));
    shape.error_m = error_in(field, shape);
    const CoarseSurface coarse(shape);
    for (const ChunkShape& child : children) {
        if (!has_data(child.id, terrain_.frame())) continue;
        done.push_back(finished(child, &coarse));
        done.back().moved_error_m = error_in(field, moved(terrain_, child, coarse));
    }
    return shape;
}

/// A node of kPieceLevel, and the finished ones below it.
struct ChunkBuilder::Piece {
    ChunkShape top;
    std::vector<ChunkMesh> below;
};

Result<ChunkBuilder::Piece> ChunkBuilder::build_piece(const ChunkId& id) const {
    const bool judges = has_data(id, terrain_.frame());
    const auto field = PostField::read(terrain_, id.first(), id.cells(), 1, judges);
    if (!field) return field.error();
    Piece piece;
    piece.top = build_in(*field, id, piece.below);
    return piece;
}

Result<ChunkShape> ChunkBuilder::build_above(const ChunkId& id, const Sink& sink,
                                             const Subtrees& subtrees) const {
    if (subtrees.find && has_data(id, terrain_.frame())) {
        const auto known = subtrees.find(id);
        if (!known) return known.error();
        if (*known) return shape_of(terrain_, **known);
    }
    std::array<ChunkShape, 4> children;
    if (id.level == kPieceLevel + 1) {
        std::array<std::optional<Result<Piece>>, 4> pieces;
        tbb::parallel_for(0, 4,
                          [&](int i) { pieces[static_cast<std::size_t>(i)] = build_piece(id.child(i)); });
        for (std::size_t i = 0; i < 4; ++i) {
            if (!*pieces[i]) return pieces[i]->error();
            for (const ChunkMesh& mesh : (*pieces[i])->below) {
                if (auto done = sink(mesh); !done) return done.error();
            }
            children[i] = std::move((*pieces[i])->top);
        }
    } else {
        for (int i = 0; i < 4; ++i) {
            auto child = build_above(id.child(i), sink, subtrees);
            if (!child) return child.error();
            children[static_cast<std::size_t>(i)] = *std::move(child);
        }
    }
    const auto field = PostField::read(terrain_, id.first(), id.cells(), 1 << (id.level - kPieceLevel));
    if (!field) return field.error();
    ChunkShape shape = simplified(*field, id, coarsened(*field, id, children));
    const CoarseSurface coarse(shape);
    std::vector<ChunkShape> shapes{shape};
    for (const ChunkShape& child : children) shapes.push_back(moved(terrain_, child, coarse));
    const auto errors = errors_in(terrain_, id, shapes);
    if (!errors) return errors.error();
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (!has_data(children[i].id, terrain_.frame())) continue;
        ChunkMesh mesh = finished(children[i], &coarse);
        mesh.moved_error_m = (*errors)[i + 1];
        if (auto done = sink(mesh); !done) return done.error();
    }
    shape.error_m = errors->front();
    if (subtrees.keep && has_data(id, terrain_.frame())) {
        if (auto done = subtrees.keep(finished(shape, nullptr)); !done) return done.error();
    }
    return shape;
}

Result<void> ChunkBuilder::build(const Sink& sink, const Subtrees& subtrees) const {
    const int top = top_chunk_level(terrain_.frame());
    if (top < 1) return {};
    const ChunkId root{top, 0, 0};
    std::optional<ChunkShape> shape;
    if (top <= kPieceLevel) {
        auto piece = build_piece(root);
        if (!piece) return piece.error();
        for (const ChunkMesh& mesh : piece->below) {
            if (auto done = sink(mesh); !done) return done.error();
        }
        shape = std::move(piece->top);
    } else {
        auto made = build_above(root, sink, subtrees);
        if (!made) return made.error();
        shape = *std::move(made);
    }
    return sink(finished(*shape, nullptr));
}

}  // namespace relevo::lod
