#include "lod/ocean/projected_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

constexpr std::array<int, 5> kSides{17, 33, 65, 129, 256};
/// Of the error, what cells are judged by: their longest edge is, and the other one is shorter.
constexpr double kSlack = 1.3;

/// Are all cells of a grid with so many vertices a side within the spacing? What lies on the horizon is not
/// asked: its cells are as deep as the horizon is far, and hide behind each other.
bool keeps_to(const SeaView& sea, const SeaSpacing& spacing, const Projection& projection, int side) {
    constexpr int kColumns = 4;
    const double cell = 1.0 / (side - 1);
    for (int i = 0; i <= kColumns; ++i) {
        const double u = std::min(static_cast<double>(i) / kColumns, 1 - cell);
        for (int row = 0; row + 1 < side; ++row) {
            const double v = row * cell;
            const glm::dvec2 at = place(projection, u, v);
            const glm::dvec2 above = place(projection, u, v + cell);
            const double nearest = std::min(glm::length(at), glm::length(above));
            if (std::max(glm::length(at), glm::length(above)) >= projection.reach_m) continue;
            const double longest =
                std::max(glm::distance(at, above), glm::distance(at, place(projection, u + cell, v)));
            if (longest > spacing.at(kSlack * sea.error_distance_m(nearest))) return false;
        }
    }
    return true;
}

}  // namespace

ProjectedMesh::ProjectedMesh() : ProjectedMesh(std::vector<int>(kSides.begin(), kSides.end())) {}

ProjectedMesh::ProjectedMesh(int side) : ProjectedMesh(std::vector<int>{side}) {}

ProjectedMesh::ProjectedMesh(std::vector<int> sides) : sides_(std::move(sides)) {
    for (const int side : sides_) patches_.push_back(ProjectedGrid(side, side).patch());
}

bool ProjectedMesh::serves(const SeaView& sea, const SeaSpacing& spacing) {
    const auto projection = ProjectedGrid(kSides.back(), kSides.back()).project(sea);
    return !projection || keeps_to(sea, spacing, *projection, kSides.back());
}

void ProjectedMesh::arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                            OceanPicture& picture) const {
    picture.copies.assign(patches_.size(), {});
    picture.numbers.clear();
    const auto coarse = ProjectedGrid(sides_.front(), sides_.front()).project(sea);
    if (!coarse) return;
    std::size_t chosen = 0;
    if (sides_.size() > 1) {
        while (chosen + 1 < sides_.size() && !keeps_to(sea, spacing, *coarse, sides_[chosen])) ++chosen;
    }
    const int side = sides_[chosen];
    const Projection projection = *ProjectedGrid(side, side).project(sea);
    picture.add(chosen, water_in({0, 0}, sea.reach_m), glm::vec4(0));
    picture.numbers = {glm::vec4(projection.d0, projection.sin2_dip),
                       glm::vec4(projection.du, projection.radius_m),
                       glm::vec4(projection.dv, projection.reach_m),
                       glm::vec4(projection.cell, projection.eye_m, 1.0 / (side - 1))};
}

}  // namespace relevo::lod
