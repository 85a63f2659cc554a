#include "lod/lstr/chunk_shape.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

#include "lod/static_mesh/grid_triangle.hpp"

namespace relevo::lod {

namespace {

bool is_before(const GridPoint& a, const GridPoint& b) {
    return std::tie(a.row, a.column) < std::tie(b.row, b.column);
}

bool is_on(const GridPoint& at, const ChunkId& id, Side side) {
    const GridPoint first = id.first();
    switch (side) {
        case Side::west:
            return at.column == first.column;
        case Side::east:
            return at.column == first.column + id.cells();
        case Side::north:
            return at.row == first.row;
        default:
            return at.row == first.row + id.cells();
    }
}

/// The post's H, moved up the ellipsoid's normal as far as a place is above it.
float moved(const PlacedPost& post, const glm::dvec3& to) {
    constexpr double kAxes2 = 1 - 6.69437999014e-3;
    const glm::dvec3 up = glm::normalize(post.position / glm::dvec3(1, 1, kAxes2));
    return static_cast<float>(static_cast<double>(post.H) + glm::dot(to - post.position, up));
}

}  // namespace

bool is_before(const PlacedPost& a, const PlacedPost& b) {
    return is_before(a.at, b.at);
}

std::uint32_t place_of(const std::vector<PlacedPost>& posts, const PlacedPost& post) {
    const auto found =
        std::lower_bound(posts.begin(), posts.end(), post,
                         [](const PlacedPost& a, const PlacedPost& b) { return is_before(a, b); });
    return static_cast<std::uint32_t>(found - posts.begin());
}

std::vector<std::uint32_t> ChunkShape::side(Side side) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t v = 0; v < posts.size(); ++v) {
        if (is_on(posts[v].at, id, side)) found.push_back(v);
    }
    return found;  // posts are row by row
}

CoarseSurface::CoarseSurface(const ChunkShape& shape) : shape_(&shape) {
    const int cells = shape.id.cells();
    bins_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(shape.triangles.size()))), 1, cells);
    bin_cells_ = (cells + bins_ - 1) / bins_;
    triangles_.resize(static_cast<std::size_t>(bins_) * static_cast<std::size_t>(bins_));
    const GridPoint first = shape.id.first();
    const auto bin = [&](int from, int at) { return std::min((at - from) / bin_cells_, bins_ - 1); };
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        const auto& [a, b, c] = shape.triangles[t];
        const auto columns =
            std::minmax({shape.posts[a].at.column, shape.posts[b].at.column, shape.posts[c].at.column});
        const auto rows = std::minmax({shape.posts[a].at.row, shape.posts[b].at.row, shape.posts[c].at.row});
        for (int y = bin(first.row, rows.first); y <= bin(first.row, rows.second); ++y) {
            for (int x = bin(first.column, columns.first); x <= bin(first.column, columns.second); ++x)
                triangles_[static_cast<std::size_t>(y * bins_ + x)].push_back(t);
        }
    }
    for (int side = 0; side < kSides; ++side)
        sides_[static_cast<std::size_t>(side)] = shape.side(static_cast<Side>(side));
}

bool CoarseSurface::has(const GridPoint& at) const {
    const auto found =
        std::lower_bound(shape_->posts.begin(), shape_->posts.end(), at,
                         [](const PlacedPost& post, const GridPoint& p) { return is_before(post.at, p); });
    return found != shape_->posts.end() && found->at == at;
}

float CoarseSurface::height(const PlacedPost& post) const {
    if (has(post.at)) return post.H;
    for (int side = 0; side < kSides; ++side) {
        if (!is_on(post.at, shape_->id, static_cast<Side>(side))) continue;
        const bool along_row = side >= 2;
        const auto place = [&](const PlacedPost& p) { return along_row ? p.at.column : p.at.row; };
        const auto& on_side = sides_[static_cast<std::size_t>(side)];
        const auto after = std::find_if(on_side.begin(), on_side.end(), [&](std::uint32_t v) {
            return place(shape_->posts[v]) > place(post);
        });
        const PlacedPost& a = shape_->posts[*(after - 1)];
        const PlacedPost& b = shape_->posts[*after];
        const double part = static_cast<double>(place(post) - place(a)) / (place(b) - place(a));
        return moved(post, (1 - part) * a.position + part * b.position);
    }
    const GridPoint first = shape_->id.first();
    const int x = std::min((post.at.column - first.column) / bin_cells_, bins_ - 1);
    const int y = std::min((post.at.row - first.row) / bin_cells_, bins_ - 1);
    for (const std::uint32_t t : triangles_[static_cast<std::size_t>(y * bins_ + x)]) {
        const PlacedPost& a = shape_->posts[shape_->triangles[t][0]];
        const PlacedPost& b = shape_->posts[shape_->triangles[t][1]];
        const PlacedPost& c = shape_->posts[shape_->triangles[t][2]];
        const auto to_a = turn(b.at, c.at, post.at);
        const auto to_b = turn(c.at, a.at, post.at);
        const auto to_c = turn(a.at, b.at, post.at);
        if (to_a < 0 || to_b < 0 || to_c < 0) continue;
        const auto area = static_cast<double>(to_a + to_b + to_c);
        return moved(post, (static_cast<double>(to_a) * a.position + static_cast<double>(to_b) * b.position +
                            static_cast<double>(to_c) * c.position) /
                               area);
    }
    return post.H;
}

}  // namespace relevo::lod
