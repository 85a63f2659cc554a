#pragma once

#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/import.hpp"
#include "ingest/mosaic/mosaic.hpp"
#include "lod/scene/scene_writer.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::ingest {

/// Writes the geoid of a scene's datum, or EGM96 where that has none here, and makes of what was written the
/// undulations of its posts: a reader's are the same. Nothing for heights above the ellipsoid.
/// \param vertical  the scene's, told whether its geoid is known
/// \param notes     told where it is not
Result<lod::UndulationGrid> write_geoid(const Mosaic& mosaic, const ImportOptions& options,
                                        lod::SceneWriter& writer, lod::VerticalReference& vertical,
                                        std::vector<std::string>& notes);

}  // namespace relevo::ingest
