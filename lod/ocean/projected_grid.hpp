#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lod/ocean/ocean_mesh.hpp"
#include "lod/ocean/sea_view.hpp"

namespace relevo::lod {

/// What throws the grid onto the sea. Directions are in the frame at the nadir: x east, y north, z up.
///
/// The ray of grid coordinates u, v in [0, 1] is d = d0 + u du + v dv; this is exact, for rays of a
/// perspective are linear on its screen. du and dv are perpendicular to each other.
struct Projection {
    glm::dvec3 d0, du, dv;
    double eye_m;     ///< of the projector above sea level; over the eye's nadir, below 0 under water
    double radius_m;  ///< of the sphere, sea level
    double sin2_dip;  ///< c = eye_m (2 R + eye_m) / (R + eye_m)^2, below 0 under water
    double reach_m;   ///< no ray goes farther along the sphere
    /// Lengths of du and dv over a cell. Where a ray of parameter t (in place()) meets the sea, a cell is t
    /// times them wide, across the ray; along it, that over the sine of the angle between ray and sea.
    glm::dvec2 cell;
};

/// Where the ray of (u, v) meets the sea: metres from the nadir along SeaView's east and north, measured
/// along the sphere; a ray that passes over the horizon is laid down on it, in its own azimuth, so that every
/// vertex has a place and neighbours stay neighbours.
///
/// With s = -d.z (d.z under water) and c = sin2_dip, the ray meets the sphere at t = (R + eye_m) tau, tau =
/// |c| / (s + sqrt(s^2 - c |d|^2)), and the arc is R atan2(tau |d.xy|, 1 + tau d.z): nothing of it cancels
/// but next to the horizon, so that it serves in float, too: to 0.5 % of the distance even there.
glm::dvec2 place(const Projection& projection, double u, double v);

/// Projected grid: C. Johanson, "Real-time water rendering", 2004, on a sphere instead of a plane. A grid
/// that is regular on a projector's screen, thrown onto the sea and stretched over what of it is in the
/// picture.
///
/// The projector hangs over the eye's nadir as high as the sea's horizon is then as far as the eye sees
/// crests (SeaView::reach_m). That lies always above the waves, and each place that can be seen is on a ray
/// of its own.
///
/// What is in the picture is exact on SeaView's sphere. The places where the chart puts the vertices on the
/// ellipsoid are seen up to 0.005 rad away from there, 0.02 rad from 10 000 km: margin() makes up for that.
class ProjectedGrid {
  public:
    /// Angle by which the picture is widened all around, its corners included, radians: 0.006, and more the
    /// farther one sees. A picture of 60 degrees loses 3 % of the vertices to it, one of 1 degree over half.
    static double margin(const SeaView& sea);

    /// \pre 2 <= columns, rows; columns * rows <= 65536
    ProjectedGrid(int columns, int rows);

    /// Vertices are (column, row): u = column / (columns - 1), v = row / (rows - 1), both ends included.
    /// Triangles turn counter-clockwise as the projector sees them: under water, clockwise from above.
    OceanPatch patch() const;

    /// Every place on the sea within the horizon at which a height within the waves is in the picture lies in
    /// [0, 1]^2. Nothing where there is none. Takes 3 us.
    std::optional<Projection> project(const SeaView& sea) const;

  private:
    int columns_, rows_;
};

}  // namespace relevo::lod
