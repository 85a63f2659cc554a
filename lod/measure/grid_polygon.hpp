#pragma once

#include <span>
#include <vector>

#include "geo/frame.hpp"
#include "geo/result.hpp"

namespace relevo::lod {

/// A closed ring in a grid, straight between its points; the last point is not the first again.
using GridRing = std::vector<geo::GridPosition>;

/// A polygon with geodesic sides as rings in a grid, clipped to nothing yet: one for each turn of longitude
/// in which it may meet the data. Sides have so many points that the ring is within 1e-6 posts of the
/// geodesic. A ring runs so that signed_area() of it is positive; around a pole of a geographic grid it goes
/// along the pole's row.
///
/// The polygon is the smaller part of the earth within its sides, as in geo::geodesic_area. Fails with
/// ErrorKind::input where sides cross each other, where it has no area, or where the smaller part is the one
/// that the grid cannot have as a whole (both poles in a geographic grid, the far pole in a polar one).
/// \pre at least 3 vertices
Result<std::vector<GridRing>> grid_rings(const geo::GridFrame& frame, std::span<const geo::LatLon> polygon);

/// In cells; positive for one that turns from columns to rows.
double signed_area(const GridRing& ring);

/// The ring's part with column (or row) at most, or at least, a value. Where it falls apart, its pieces hang
/// together by sides along the cut, there and back: every integral over the ring is right (Sutherland and
/// Hodgman 1974).
enum class Side { low, high };
GridRing clip_columns(const GridRing& ring, double column, Side side);
GridRing clip_rows(const GridRing& ring, double row, Side side);

}  // namespace relevo::lod
