#include "lod/lstr/post_insertion.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace relevo::lod {

namespace {

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
void insert_farthest(const PostField& field, const GridPoint& first, int cells, double limit_m,
                     PlanarMesh& mesh) {
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
        const PostField::Worst worst = field.worst(corners, first, cells);
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
void mend_edges(const PostField& field, const GridPoint& first, int cells, double limit_m, PlanarMesh& mesh) {
    std::vector<IndexTriangle> open = mesh.triangles();
    std::size_t flips_left = 4 * open.size();
    while (!open.empty()) {
        const IndexTriangle t = open.back();
        open.pop_back();
        if (!mesh.has(t) || error_of(field, placed(mesh, t), limit_m) <= limit_m) continue;
        const PostField::Worst worst = field.worst(placed(mesh, t), first, cells);
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

}  // namespace

void insert_posts(const PostField& field, const GridPoint& first, int cells, double limit_m,
                  PlanarMesh& mesh) {
    insert_farthest(field, first, cells, limit_m, mesh);
    mend_edges(field, first, cells, limit_m, mesh);
}

}  // namespace relevo::lod
