#include "lod/lstr/chunk_simplifier.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lod/lstr/border_line.hpp"
#include "lod/lstr/empty_shape.hpp"
#include "lod/lstr/post_insertion.hpp"
#include "lod/static_mesh/grid_triangle.hpp"

namespace relevo::lod {

namespace {

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

/// \param removable  what goes first, places in the field; null: none
ChunkShape simplified(const PostField& field, const ChunkId& id, double limit_m, const PostSet* removable,
                      PlanarMesh mesh) {
    insert_posts(field, id.first(), id.cells(), limit_m, mesh);

    // By weight: what the filter finds first, then from the middle to the border.
    const GridPoint first = id.first();
    std::vector<std::pair<int, std::uint32_t>> left;
    for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
        if (!mesh.is_alive(v) || mesh.on_border(v)) continue;
        const GridPoint& at = mesh.post(v).at;
        const int inside = std::min({at.column - first.column, first.column + id.cells() - at.column,
                                     at.row - first.row, first.row + id.cells() - at.row});
        const bool goes_first = removable != nullptr && removable->contains({at.column - field.first().column,
                                                                             at.row - field.first().row});
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

}  // namespace

ChunkShape finest_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors,
                        const PostSet& removable) {
    ChunkShape begin = empty_shape(field, id, errors);
    PlanarMesh mesh(std::move(begin.posts), begin.triangles, id.first(), id.cells());
    return simplified(field, id, errors.of_level(id.level), &removable, std::move(mesh));
}

ChunkShape coarser_shape(const PostField& field, const ChunkId& id, const ChunkErrors& errors,
                         const std::array<ChunkShape, 4>& children) {
    PlanarMesh mesh = joined(id, children);
    thin_border(field, id, errors.of_side(id.level), mesh);
    return simplified(field, id, errors.of_level(id.level), nullptr, std::move(mesh));
}

}  // namespace relevo::lod
