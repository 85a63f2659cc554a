#include "lod/ocean/ocean_mesh.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace relevo::lod {

OceanPatch cells_patch(int columns, int rows) {
    OceanPatch patch;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) patch.vertices.emplace_back(x, y);
    }
    const int width = columns + 1;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int south_west = y * width + x;
            const int north_west = south_west + width;
            for (const int at :
                 {south_west, south_west + 1, north_west + 1, south_west, north_west + 1, north_west})
                patch.indices.push_back(static_cast<std::uint16_t>(at));
        }
    }
    return patch;
}

bool patch_in_view(const SeaView& sea, const std::array<glm::dvec2, 4>& corners) {
    const glm::dvec2 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    std::array<glm::dvec3, 4> at{};
    double radius_m = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        at[i] = sea.offset(corners[i], 0);
        radius_m = std::max(radius_m, glm::distance(corners[i], middle));
    }
    if (glm::length(middle) - radius_m > sea.reach_m) return false;
    // The bulge of the sea over the flat between the corners; and the chart's metres and SeaView's sphere,
    // which are right to half a percent.
    const double margin =
        1.1 * radius_m * radius_m / (2 * sea.radius_m) + 0.005 * (radius_m + glm::length(middle));
    const auto outside = [&](const glm::dvec3& plane) {
        const double waves =
            sea.crest_m * (std::abs(glm::dot(plane, sea.up)) + 2 * glm::length(middle) / sea.radius_m);
        return std::all_of(at.begin(), at.end(),
                           [&](const glm::dvec3& p) { return glm::dot(plane, p) > margin + waves; });
    };
    const auto& sides = sea.view.side_planes();
    return std::none_of(sides.begin(), sides.end(), outside) && !outside(-sea.view.forward());
}

}  // namespace relevo::lod
