#include "lod/soar/pick.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

#include "lod/scene/metric_code.hpp"
#include "lod/soar/cell.hpp"

namespace relevo::lod {

namespace {

constexpr double kUrgency = 1;  // of missing tiles: as one that is off by a pixel

class Search {
  public:
    Search(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction, double exaggeration)
        : terrain_(terrain),
          tiles_(terrain.tiles()),
          posts_(terrain.posts()),
          origin_(origin.m),
          direction_(direction),
          exaggeration_(exaggeration) {}

    std::optional<Hit> run() {
        const int side = 1 << terrain_.levels();
        std::array<Corner, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const TileStore::Corner& corner = tiles_.corners()[k];
            corners[k] = {corner.post, offset(corner.post, corner.H, corner.N)};
        }
        // The centre and all that is older than the first tile's vertices are always in memory.
        const GridPoint middle{side / 2, side / 2};
        const TileStore::Resident* root = tiles_.find(tiles_.grid().root());
        if (root == nullptr) return std::nullopt;
        const auto [lanes, lane] = root->tile.find(tiles_.grid(), middle);
        const Corner centre{
            middle, offset(middle, static_cast<double>(lanes->H[lane]), static_cast<double>(lanes->N[lane]))};
        for (std::size_t k = 0; k < 4; ++k) descend({corners[k], corners[(k + 1) % 4], centre}, 1);
        if (nearest_) nearest_->is_exact = is_exact_;
        return nearest_;
    }

  private:
    struct Corner {
        GridPoint post;
        glm::dvec3 offset;  // from the ray's origin
    };
    using Triangle = std::array<Corner, 3>;

    glm::dvec3 offset(const GridPoint& post, double H, double N) const {
        return terrain_.positions().at(post.column, post.row, N + exaggeration_ * H) - origin_;
    }

    /// Where the ray enters a vertex's sphere; nothing where it misses it.
    std::optional<double> entry_distance(const glm::dvec3& centre, std::uint16_t code, int level) const {
        const LevelBound& bare = terrain_.level_bounds()[static_cast<std::size_t>(level)];
        const double radius =
            exaggeration_ * static_cast<double>(decode(code)) + std::abs(exaggeration_ - 1) * bare.radius_m;
        const double along = glm::dot(centre, direction_);
        const glm::dvec3 aside = centre - along * direction_;
        const double half_chord2 = radius * radius - glm::dot(aside, aside);
        if (half_chord2 < 0) return std::nullopt;
        const double half_chord = std::sqrt(half_chord2);
        if (along + half_chord < 0) return std::nullopt;
        return along - half_chord;
    }

    /// The tile of a vertex on the side of a triangle's apex.
    TileId tile_of(const GridPoint& vertex, const GridPoint& apex) const {
        const TileGrid& grid = tiles_.grid();
        const int level = std::countr_zero(static_cast<unsigned>(vertex.column | vertex.row));
        const int posts = grid.cells(level) << level;
        const auto towards = [&](int at, int to) {
            return at % posts == 0 && to < at ? at / posts - 1 : std::min(at / posts, grid.across(level) - 1);
        };
        return {level, towards(vertex.column, apex.column), towards(vertex.row, apex.row)};
    }

    void descend(const Triangle& triangle, int level) {
        const auto& [left, right, apex] = triangle;
        if (level == 2 * terrain_.levels()) return meet_cell(triangle);
        const GridPoint post = midpoint(left.post, right.post);
        const TileId id = tile_of(post, apex.post);
        if (!tiles_.grid().holds_data(id)) return;
        const TileStore::Resident* resident = tiles_.find(id);
        if (resident == nullptr) {
            tiles_.want(id, kUrgency);
            is_exact_ = false;
            meet(triangle);
            return;
        }
        tiles_.use(*resident);
        const auto [lanes, lane] = resident->tile.find(tiles_.grid(), post);
        if (lanes->radius[lane] == 0) return;
        const Corner middle{
            post, offset(post, static_cast<double>(lanes->H[lane]), static_cast<double>(lanes->N[lane]))};
        const auto entry = entry_distance(middle.offset, lanes->radius[lane], level);
        if (!entry || (nearest_ && *entry > nearest_->distance_m)) return;
        Triangle first{apex, left, middle};
        Triangle second{right, apex, middle};
        // The nearer half first: what it hits spares most of the other.
        if (glm::dot(left.offset - right.offset, direction_) > 0) std::swap(first, second);
        descend(first, level + 1);
        descend(second, level + 1);
    }

    void meet_cell(const Triangle& triangle) {
        const auto& [a, b, c] = triangle;
        if (posts_.is_valid_cell(std::min({a.post.column, b.post.column, c.post.column}),
                                 std::min({a.post.row, b.post.row, c.post.row}))) {
            meet(triangle);
        }
    }

    /// Intersects a triangle (Moeller & Trumbore 1997), from either side; true where it is hit nearest.
    bool meet(const Triangle& triangle) {
        const glm::dvec3& corner = triangle[0].offset;
        const glm::dvec3 side1 = triangle[1].offset - corner;
        const glm::dvec3 side2 = triangle[2].offset - corner;
        const glm::dvec3 p = glm::cross(direction_, side2);
        const double determinant = glm::dot(side1, p);
        if (determinant == 0) return false;
        const double u = glm::dot(-corner, p) / determinant;
        const glm::dvec3 q = glm::cross(-corner, side1);
        const double v = glm::dot(direction_, q) / determinant;
        // A ray through an edge must not slip between its two triangles.
        constexpr double kRounding = 1e-9;
        if (u < -kRounding || v < -kRounding || u + v > 1 + kRounding) return false;
        const double distance = glm::dot(side2, q) / determinant;
        if (distance < 0 || (nearest_ && distance >= nearest_->distance_m)) return false;
        const double w = 1 - u - v;
        const auto& [a, b, c] = triangle;
        nearest_ = Hit{{w * a.post.column + u * b.post.column + v * c.post.column,
                        w * a.post.row + u * b.post.row + v * c.post.row},
                       distance};
        return true;
    }

    const Terrain& terrain_;
    const TileStore& tiles_;
    TruePosts::Reader posts_;
    const glm::dvec3 origin_;
    const glm::dvec3 direction_;
    const double exaggeration_;
    std::optional<Hit> nearest_;
    bool is_exact_ = true;
};

}  // namespace

std::optional<Hit> pick(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction,
                        double exaggeration) {
    return Search(terrain, origin, direction, exaggeration).run();
}

std::optional<Hit> pick_exactly(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction,
                                double exaggeration) {
    TileStore& tiles = terrain.tiles();
    for (;;) {
        const auto hit = pick(terrain, origin, direction, exaggeration);
        if (hit && hit->is_exact) return hit;
        tiles.start_frame();
        if (tiles.figures().pending_tiles == 0 || tiles.figures().starved() || !tiles.wait()) return hit;
        tiles.start_frame();
    }
}

}  // namespace relevo::lod
