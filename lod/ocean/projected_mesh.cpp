#include "lod/ocean/projected_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relevo::lod {

namespace {

/// The largest side of a projection's cells over the spacing that is allowed there.
double coarseness(const SeaView& sea, const SeaSpacing& spacing, const Projection& projection) {
    constexpr int kPlaces = 12;
    double worst = 0;
    for (int i = 0; i <= kPlaces; ++i) {
        for (int k = 0; k <= kPlaces; ++k) {
            const double u = static_cast<double>(i) / kPlaces;
            const double v = static_cast<double>(k) / kPlaces;
            constexpr double kStep = 1e-4;
            const glm::dvec2 at = place(projection, u, v);
            const double across = glm::distance(at, place(projection, u + kStep, v)) / kStep;
            const double along = glm::distance(at, place(projection, u, v + kStep)) / kStep;
            const double most = spacing.at(glm::length(sea.offset(at, 0)));
            worst = std::max(worst, std::max(across, along) / most);
        }
    }
    return worst;
}

}  // namespace

ProjectedMesh::ProjectedMesh() : ProjectedMesh(std::vector<int>{17, 33, 65, 129, 256}) {}

ProjectedMesh::ProjectedMesh(int side) : ProjectedMesh(std::vector<int>{side}) {}

ProjectedMesh::ProjectedMesh(std::vector<int> sides) : sides_(std::move(sides)) {
    for (const int side : sides_) patches_.push_back(ProjectedGrid(side, side).patch());
}

void ProjectedMesh::arrange(const SeaView& sea, const SeaSpacing& spacing, const WaterIn& water_in,
                            OceanPicture& picture) const {
    picture.copies.assign(patches_.size(), {});
    picture.numbers.clear();
    const auto coarse = ProjectedGrid(sides_.front(), sides_.front()).project(sea);
    if (!coarse) return;
    std::size_t chosen = 0;
    if (sides_.size() > 1) {
        const double cells = coarseness(sea, spacing, *coarse);
        while (chosen + 1 < sides_.size() && sides_[chosen] - 1 < cells) ++chosen;
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
