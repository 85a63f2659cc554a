#include <vector>

#include <gtest/gtest.h>

#include "tests/viewer/studio.hpp"

namespace relevo::test {
namespace {

/// A square across the view at a distance, of a level of its own: corners on every `stride`-th post.
void add_square(lod::Mesh& mesh, const lod::View& view, double distance, double half, int stride) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto corner = [&](double right, double up, int column, int row) {
        const glm::dvec3 at = distance * view.forward() + right * half * view.right() + up * half * view.up();
        mesh.vertices.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z),
                                 static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)});
    };
    corner(-1, -1, 0, stride);
    corner(1, -1, stride, stride);
    corner(1, 1, stride, 0);
    corner(-1, 1, stride, stride);
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

// DESIGN: 2 cm apart at 10 km and 10 cm at 100 km stay apart, whatever is drawn first.
TEST(Depth, KeepsNearSurfacesInFrontOfFarOnes) {
    const auto frame = geographic_frame(65, 65);
    Studio studio(make_terrain(frame, make_heights(frame, [](int, int) { return 100.0; })));
    const lod::View view({.eye = above(studio.terrain(), 32, 32, 2000),
                          .heading = geo::Degrees{37},
                          .pitch = geo::Degrees{10},
                          .roll = geo::Degrees{5},
                          .fov = geo::Degrees{20},
                          .width = 64,
                          .height = 64});
    const viewer::DrawSettings settings{.layer = viewer::Layer::lod, .sun = {}, .background = kMagenta};
    const auto drawn = [&](const std::vector<std::pair<double, int>>& squares) {
        lod::Mesh mesh;
        for (const auto& [distance, stride] : squares)
            add_square(mesh, view, distance, 0.3 * distance, stride);
        return studio.draw(view, mesh, settings).rgb;
    };
    for (const auto& [distance, apart] : {std::pair(10.0, 1e-5), std::pair(1e3, 2e-3), std::pair(10e3, 0.02),
                                          std::pair(100e3, 0.1), std::pair(1e6, 2.0)}) {
        const std::pair near(distance, 2);
        const std::pair far(distance + apart, 16);
        const auto near_alone = drawn({near});
        ASSERT_NE(near_alone, drawn({far}));
        EXPECT_EQ(drawn({near, far}), near_alone) << apart << " m apart at " << distance << " m";
        EXPECT_EQ(drawn({far, near}), near_alone) << apart << " m apart at " << distance << " m";
    }
}

}  // namespace
}  // namespace relevo::test
