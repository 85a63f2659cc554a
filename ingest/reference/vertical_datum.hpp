#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "geo/geoid.hpp"
#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/reference/crs.hpp"
#include "lod/scene/scene_info.hpp"

namespace relevo::ingest {

/// What the heights of a vertical CRS are above, once they are metres upwards: CRSs of one datum in metres,
/// in feet and as depths have one answer.
lod::VerticalReference vertical_reference_of(const VerticalCrs& crs);

/// A vertical datum as people name it: "egm96", "ellipsoid", "egm2008", "EPSG:5703", or PROJ's name of a
/// vertical CRS ("NAVD88 height"). Fails with ErrorKind::usage where PROJ knows no such datum.
Result<lod::VerticalReference> vertical_reference_named(const std::string& name);

/// Are both heights above the same surface?
bool same_datum(const lod::VerticalReference& a, const lod::VerticalReference& b);

/// The geoid that makes heights above a datum ellipsoidal: h = H + N. Nothing for heights above the ellipsoid
/// (N is 0). EGM96 and what PROJ has the grid for in its own data come from there; `geoid_file` (--geoid)
/// serves any other datum, and goes before PROJ's grid. Fails with ErrorKind::input and a message that names
/// the grid where it is not here.
/// \param area  where it will be asked, degrees of longitude and latitude, east above west: chooses among the
///              grids of a datum, and of large ones only that part is read. A place may still be uncovered
///              (geo::Geoid::covers).
Result<std::optional<geo::Geoid>> geoid_of(const lod::VerticalReference& reference,
                                           const std::optional<std::filesystem::path>& geoid_file,
                                           const std::optional<Bounds>& area = {});

}  // namespace relevo::ingest
