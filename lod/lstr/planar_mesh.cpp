#include "lod/lstr/planar_mesh.hpp"

#include <algorithm>
#include <utility>

#include "lod/static_mesh/grid_triangle.hpp"

namespace relevo::lod {

namespace {

/// Is d inside the circle through a, b, c, which go counter-clockwise?
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
    const auto row = [&](const GridPoint& p) {
        const double x = p.column - d.column;
        const double y = d.row - p.row;
        return std::array{x, y, x * x + y * y};
    };
    const auto [ax, ay, aa] = row(a);
    const auto [bx, by, bb] = row(b);
    const auto [cx, cy, cc] = row(c);
    return ax * (by * cc - bb * cy) - ay * (bx * cc - bb * cx) + aa * (bx * cy - by * cx) > 0;
}

}  // namespace

PlanarMesh::PlanarMesh(std::vector<PlacedPost> posts, const std::vector<IndexTriangle>& triangles,
                       const GridPoint& first, int cells)
    : posts_(std::move(posts)),
      rings_(posts_.size()),
      on_border_(posts_.size()),
      first_(first),
      cells_(cells) {
    for (std::size_t v = 0; v < posts_.size(); ++v) {
        on_border_[v] = is_border(posts_[v].at);
    }
    // Of each vertex the triangles around it, as pairs of the next corner and the one after.
    std::vector<std::uint32_t> begin(posts_.size() + 1);
    for (const IndexTriangle& t : triangles)
        for (const std::uint32_t v : t) ++begin[v + 1];
    for (std::size_t v = 0; v < posts_.size(); ++v) begin[v + 1] += begin[v];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(3 * triangles.size());
    std::vector<std::uint32_t> filled(begin.begin(), begin.end() - 1);
    for (const IndexTriangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) pairs[filled[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
    for (std::size_t v = 0; v < posts_.size(); ++v) {
        const auto from = pairs.begin() + begin[v];
        const auto to = pairs.begin() + begin[v + 1];
        if (from == to) continue;
        // Whatever the order of the triangles, the ring is the same: a mesh that was read makes the same
        // ones. On the border the chain begins where nothing comes before.
        auto start = std::min_element(from, to);
        if (on_border_[v]) {
            start = std::find_if(from, to, [&](const auto& pair) {
                return std::none_of(from, to, [&](const auto& other) { return other.second == pair.first; });
            });
        }
        std::vector<std::uint32_t>& ring = rings_[v];
        ring.reserve(static_cast<std::size_t>(to - from) + 1);
        ring.push_back(start->first);
        std::uint32_t next = start->second;
        while (static_cast<std::ptrdiff_t>(ring.size()) < to - from) {
            ring.push_back(next);
            next = std::find_if(from, to, [&](const auto& pair) { return pair.first == next; })->second;
        }
        if (on_border_[v]) ring.push_back(next);
    }
}

bool PlanarMesh::plan(std::uint32_t vertex, Plan& plan) const {
    plan.polygon = rings_[vertex];
    plan.triangles.clear();
    const auto at = [&](std::uint32_t i) -> const GridPoint& { return posts_[plan.polygon[i]].at; };
    std::vector<std::uint32_t> left(plan.polygon.size());
    for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
    // Ear by ear: one whose circle holds none of the others, if there is such.
    while (left.size() >= 3) {
        const std::size_t count = left.size();
        std::size_t best = count;
        std::size_t fewest = count;
        for (std::size_t i = 0; i < count && fewest > 0; ++i) {
            const GridPoint& a = at(left[(i + count - 1) % count]);
            const GridPoint& b = at(left[i]);
            const GridPoint& c = at(left[(i + 1) % count]);
            if (turn(a, b, c) <= 0) continue;
            bool is_ear = true;
            std::size_t inside = 0;
            for (std::size_t j = 2; j + 1 < count && is_ear; ++j) {
                const GridPoint& d = at(left[(i + j) % count]);
                is_ear = turn(a, b, d) < 0 || turn(b, c, d) < 0 || turn(c, a, d) < 0;
                if (in_circle(a, b, c, d)) ++inside;
            }
            if (!is_ear || inside >= fewest) continue;
            fewest = inside;
            best = i;
        }
        if (best == count) return false;
        plan.triangles.push_back({left[(best + count - 1) % count], left[best], left[(best + 1) % count]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return true;
}

bool PlanarMesh::plan_fan(std::uint32_t corner, Plan& plan) const {
    plan.triangles.clear();
    const auto count = static_cast<std::uint32_t>(plan.polygon.size());
    const auto at = [&](std::uint32_t i) -> const GridPoint& { return posts_[plan.polygon[i]].at; };
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
        const std::uint32_t b = (corner + i) % count;
        const std::uint32_t c = (corner + i + 1) % count;
        if (turn(at(corner), at(b), at(c)) <= 0) return false;
        plan.triangles.push_back({corner, b, c});
    }
    return true;
}

void PlanarMesh::take(std::uint32_t vertex, const Plan& plan) {
    const auto count = static_cast<std::uint32_t>(plan.polygon.size());
    const auto distance = [count](std::uint32_t from, std::uint32_t to) {
        return (to + count - from) % count;
    };
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i < count; ++i) {
        // New edges of this corner, in the order in which the polygon's corners follow it. The polygon's own
        // edges are there already, but for the one along the border that the vertex was on.
        ends.clear();
        const bool open = on_border_[vertex];
        for (const IndexTriangle& t : plan.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (t[k] != i) continue;
                for (const std::uint32_t j : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
                    const bool along = distance(i, j) == 1 || distance(j, i) == 1;
                    const bool closing = open && ((i == 0 && j + 1 == count) || (j == 0 && i + 1 == count));
                    if (!along || closing) ends.push_back(j);
                }
            }
        }
        std::sort(ends.begin(), ends.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return distance(i, a) < distance(i, b); });
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        for (std::uint32_t& j : ends) j = plan.polygon[j];
        std::vector<std::uint32_t>& ring = rings_[plan.polygon[i]];
        const auto place = ring.erase(std::find(ring.begin(), ring.end(), vertex));
        ring.insert(place, ends.begin(), ends.end());
    }
    rings_[vertex].clear();
}

bool PlanarMesh::has(const IndexTriangle& triangle) const {
    const std::vector<std::uint32_t>& ring = rings_[triangle[0]];
    const auto found = std::find(ring.begin(), ring.end(), triangle[1]);
    if (found == ring.end()) return false;
    const auto next = found + 1;
    if (next != ring.end()) return *next == triangle[2];
    return !on_border_[triangle[0]] && ring.front() == triangle[2];
}

std::optional<std::array<IndexTriangle, 2>> PlanarMesh::flipped(std::uint32_t a, std::uint32_t b) const {
    const std::vector<std::uint32_t>& ring = rings_[a];
    const auto count = static_cast<std::size_t>(ring.size());
    const auto i = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), b) - ring.begin());
    if (on_border_[a] && (i == 0 || i + 1 == count)) return std::nullopt;
    const std::uint32_t d = ring[(i + count - 1) % count];
    const std::uint32_t c = ring[(i + 1) % count];
    const auto at = [&](std::uint32_t v) -> const GridPoint& { return posts_[v].at; };
    if (turn(at(a), at(d), at(c)) <= 0 || turn(at(d), at(b), at(c)) <= 0) return std::nullopt;
    return std::array<IndexTriangle, 2>{{{a, d, c}, {d, b, c}}};
}

void PlanarMesh::flip(std::uint32_t a, std::uint32_t b, const std::array<IndexTriangle, 2>& triangles) {
    const std::uint32_t d = triangles[0][1];
    const std::uint32_t c = triangles[0][2];
    std::erase(rings_[a], b);
    std::erase(rings_[b], a);
    const auto put_after = [&](std::uint32_t of, std::uint32_t before, std::uint32_t vertex) {
        std::vector<std::uint32_t>& ring = rings_[of];
        ring.insert(std::find(ring.begin(), ring.end(), before) + 1, vertex);
    };
    put_after(c, a, d);
    put_after(d, b, c);
}

std::uint32_t PlanarMesh::insert(const PlacedPost& post, const IndexTriangle& triangle) {
    const auto vertex = static_cast<std::uint32_t>(posts_.size());
    posts_.push_back(post);
    on_border_.push_back(false);
    rings_.emplace_back();
    const auto at = [&](std::uint32_t v) -> const GridPoint& { return posts_[v].at; };
    const auto put_between = [&](std::uint32_t of, std::uint32_t before) {
        std::vector<std::uint32_t>& ring = rings_[of];
        ring.insert(std::find(ring.begin(), ring.end(), before) + 1, vertex);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3], c = triangle[(i + 2) % 3];
        if (turn(at(a), at(b), post.at) != 0) continue;
        // On the edge from a to b, with d on its other side.
        std::vector<std::uint32_t>& from_a = rings_[a];
        const auto to_b = std::find(from_a.begin(), from_a.end(), b);
        const std::uint32_t d = to_b == from_a.begin() ? from_a.back() : *(to_b - 1);
        *to_b = vertex;
        std::replace(rings_[b].begin(), rings_[b].end(), a, vertex);
        put_between(c, a);
        put_between(d, b);
        rings_[vertex] = {a, d, b, c};
        return vertex;
    }
    for (std::size_t i = 0; i < 3; ++i) put_between(triangle[i], triangle[(i + 1) % 3]);
    rings_[vertex] = {triangle.begin(), triangle.end()};
    return vertex;
}

void PlanarMesh::legalize(std::uint32_t vertex) {
    std::vector<std::uint32_t> open = rings_[vertex];
    while (!open.empty()) {
        // The edge from here to the ring's next vertex.
        const std::uint32_t a = open.back();
        open.pop_back();
        const std::vector<std::uint32_t>& ring = rings_[vertex];
        const auto found = std::find(ring.begin(), ring.end(), a);
        if (found == ring.end()) continue;
        const std::uint32_t b = found + 1 == ring.end() ? ring.front() : *(found + 1);
        const auto flip_to = flipped(a, b);
        if (!flip_to) continue;
        const std::uint32_t across = (*flip_to)[0][1] == vertex ? (*flip_to)[0][2] : (*flip_to)[0][1];
        if (!in_circle(posts_[vertex].at, posts_[a].at, posts_[b].at, posts_[across].at)) continue;
        flip(a, b, *flip_to);
        open.push_back(a);
        open.push_back(across);
    }
}

std::vector<IndexTriangle> PlanarMesh::triangles() const {
    std::vector<IndexTriangle> found;
    for (std::uint32_t v = 0; v < posts_.size(); ++v) {
        const std::vector<std::uint32_t>& ring = rings_[v];
        const std::size_t count = ring.size() - (on_border_[v] && !ring.empty() ? 1 : 0);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t a = ring[i];
            const std::uint32_t b = ring[(i + 1) % ring.size()];
            if (v < a && v < b) found.push_back({v, a, b});
        }
    }
    return found;
}

}  // namespace relevo::lod
