#pragma once

#include <cstdint>
#include <optional>

#include "lod/mesh.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// How far the drawn surface moved from one frame to the next, in pixels.
struct SurfaceJump {
    double max_px = 0;
    double p99_px = 0;
    std::uint64_t vertices = 0;  ///< compared
};

/// Where the drawn surface of the frame before and that of a view's are at the same grid coordinates, both
/// seen by the view: what a viewer sees move that no camera moved. Compared at the vertices of both meshes
/// that are in the view's picture and under triangles of both. Meshes of one bisection are nested or apart,
/// so between these vertices the surfaces part no farther than at them, but for the perspective; for other
/// meshes it is a sample. A point that lies behind the eye counts as moved by the picture's diagonal.
///
/// Nothing where no such vertex is in the picture. \param columns, rows  posts of the data; vertices in the
/// padding are left out
std::optional<SurfaceJump> surface_jump(const Mesh& before, const geo::Ecef& eye_before, const Mesh& after,
                                        const View& view, int columns, int rows);

}  // namespace relevo::lod
