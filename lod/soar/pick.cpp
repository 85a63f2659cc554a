#include "lod/soar/pick.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "lod/scene/metric_code.hpp"
#include "lod/soar/cell.hpp"

namespace relevo::lod {

namespace {

class Search {
  public:
    Search(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction, double exaggeration)
        : terrain_(terrain), origin_(origin.m), direction_(direction), exaggeration_(exaggeration) {}

    std::optional<Hit> run() {
        const int side = 1 << terrain_.levels();
        const GridPoint centre{side / 2, side / 2};
        const GridPoint corners[] = {{0, 0}, {0, side}, {side, side}, {side, 0}};
        for (int k = 0; k < 4; ++k) descend({corners[k], corners[(k + 1) % 4], centre}, 1);
        return nearest_;
    }

  private:
    glm::dvec3 offset(const GridPoint& post) const {
        return terrain_.position(post.column, post.row, exaggeration_) - origin_;
    }

    /// Where the ray enters a vertex's sphere; nothing where it misses it.
    std::optional<double> entry_distance(const GridPoint& middle, int level) const {
        const Terrain::Post& post = terrain_.post(middle.column, middle.row);
        if (post.radius == 0) return std::nullopt;
        const LevelBound& bare = terrain_.level_bounds()[static_cast<std::size_t>(level)];
        const double radius = exaggeration_ * static_cast<double>(decode(post.radius)) +
                              std::abs(exaggeration_ - 1) * bare.radius_m;
        const glm::dvec3 centre = offset(middle);
        const double along = glm::dot(centre, direction_);
        const glm::dvec3 aside = centre - along * direction_;
        const double half_chord2 = radius * radius - glm::dot(aside, aside);
        if (half_chord2 < 0) return std::nullopt;
        const double half_chord = std::sqrt(half_chord2);
        if (along + half_chord < 0) return std::nullopt;
        return along - half_chord;
    }

    void descend(const CellTriangle& triangle, int level) {
        const auto& [left, right, apex] = triangle;
        if (level == 2 * terrain_.levels()) return meet(triangle);
        const GridPoint middle = midpoint(left, right);
        const auto entry = entry_distance(middle, level);
        if (!entry || (nearest_ && *entry > nearest_->distance_m)) return;
        CellTriangle first{apex, left, middle};
        CellTriangle second{right, apex, middle};
        // The nearer half first: what it hits spares most of the other.
        if (glm::dot(offset(left) - offset(right), direction_) > 0) std::swap(first, second);
        descend(first, level + 1);
        descend(second, level + 1);
    }

    /// Intersects one finest triangle (Moeller & Trumbore 1997), from either side.
    void meet(const CellTriangle& triangle) {
        const GridPoint cell{std::min({triangle[0].column, triangle[1].column, triangle[2].column}),
                             std::min({triangle[0].row, triangle[1].row, triangle[2].row})};
        if (!is_valid_cell(terrain_, cell)) return;
        const glm::dvec3 corner = offset(triangle[0]);
        const glm::dvec3 side1 = offset(triangle[1]) - corner;
        const glm::dvec3 side2 = offset(triangle[2]) - corner;
        const glm::dvec3 p = glm::cross(direction_, side2);
        const double determinant = glm::dot(side1, p);
        if (determinant == 0) return;
        const double u = glm::dot(-corner, p) / determinant;
        const glm::dvec3 q = glm::cross(-corner, side1);
        const double v = glm::dot(direction_, q) / determinant;
        // A ray through an edge must not slip between its two triangles.
        constexpr double kRounding = 1e-9;
        if (u < -kRounding || v < -kRounding || u + v > 1 + kRounding) return;
        const double distance = glm::dot(side2, q) / determinant;
        if (distance < 0 || (nearest_ && distance >= nearest_->distance_m)) return;
        const double w = 1 - u - v;
        nearest_ = Hit{{w * triangle[0].column + u * triangle[1].column + v * triangle[2].column,
                        w * triangle[0].row + u * triangle[1].row + v * triangle[2].row},
                       distance};
    }

    const Terrain& terrain_;
    const glm::dvec3 origin_;
    const glm::dvec3 direction_;
    const double exaggeration_;
    std::optional<Hit> nearest_;
};

}  // namespace

std::optional<Hit> pick(const Terrain& terrain, const geo::Ecef& origin, const glm::dvec3& direction,
                        double exaggeration) {
    return Search(terrain, origin, direction, exaggeration).run();
}

}  // namespace relevo::lod
