#include "lod/lstr/chunk_seams.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace relevo::lod {

namespace {

using Chain = std::vector<std::uint32_t>;

class Stitching {
  public:
    Stitching(std::uint32_t base, std::uint32_t* index) : base_(base), index_(index) {}

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        *index_++ = base_ + a;
        *index_++ = base_ + b;
        *index_++ = base_ + c;
    }

    /// \param on_edges  what lies between each corner and the next
    void add(const IndexTriangle& t, const std::array<Chain, 3>& on_edges) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (on_edges[k].empty()) continue;
            const std::size_t next = (k + 1) % 3;
            const std::size_t across = (k + 2) % 3;
            std::uint32_t last = t[k];
            for (std::size_t i = 0; i <= on_edges[k].size(); ++i) {
                const bool is_first = i == 0;
                const bool is_last = i == on_edges[k].size();
                const std::uint32_t at = is_last ? t[next] : on_edges[k][i];
                // The first and the last have one of the triangle's other edges.
                std::array<Chain, 3> rest;
                if (is_last) rest[1] = on_edges[next];
                if (is_first) rest[2] = on_edges[across];
                add({last, at, t[across]}, rest);
                last = at;
            }
            return;
        }
        add(t[0], t[1], t[2]);
    }

    std::uint32_t* index() const { return index_; }

  private:
    std::uint32_t base_;
    std::uint32_t* index_;
};

Chain chain_of(const SeamEdge& edge, const std::vector<SeamVertex>& finer) {
    Chain found;
    const auto first =
        std::lower_bound(finer.begin(), finer.end(), edge.place,
                         [](const SeamVertex& vertex, std::uint32_t place) { return vertex.place < place; });
    for (auto at = first; at != finer.end() && at->place == edge.place; ++at) found.push_back(at->vertex);
    if (!edge.forward) std::reverse(found.begin(), found.end());
    return found;
}

}  // namespace

std::vector<SeamEdge> seam_edges(const std::vector<IndexTriangle>& triangles,
                                 const std::array<std::vector<SideVertex>, kSides>& sides) {
    struct OnSide {
        Side side;
        std::uint32_t place;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, OnSide> on_sides;
    for (const Side side : {Side::west, Side::east, Side::north, Side::south}) {
        const auto& vertices = sides[static_cast<std::size_t>(side)];
        for (std::uint32_t i = 0; i + 1 < vertices.size(); ++i)
            on_sides[{vertices[i].vertex, vertices[i + 1].vertex}] = {side, i};
    }
    std::vector<SeamEdge> found;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[t][k];
            const std::uint32_t to = triangles[t][(k + 1) % 3];
            for (const bool forward : {true, false}) {
                const auto on = on_sides.find(forward ? std::pair{from, to} : std::pair{to, from});
                if (on != on_sides.end()) found.push_back({t, k, on->second.side, on->second.place, forward});
            }
        }
    }
    return found;
}

std::uint32_t* stitch(const std::vector<IndexTriangle>& triangles, const std::vector<SeamEdge>& edges,
                      const SeamVertices& finer, std::uint32_t base, std::uint32_t* index) {
    Stitching stitching(base, index);
    auto edge = edges.begin();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        std::array<Chain, 3> on_edges;
        for (; edge != edges.end() && edge->triangle == t; ++edge)
            on_edges[edge->corner] = chain_of(*edge, finer[static_cast<std::size_t>(edge->side)]);
        stitching.add(triangles[t], on_edges);
    }
    return stitching.index();
}

}  // namespace relevo::lod
