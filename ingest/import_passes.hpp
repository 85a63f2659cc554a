#pragma once

#include "ingest/mosaic/mosaic.hpp"
#include "ingest/posts/outliers.hpp"
#include "ingest/progress.hpp"
#include "ingest/sea/sea_classifier.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/scene/draft_posts.hpp"
#include "lod/scene/scene_writer.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::ingest {

// The steps of an import. Each goes once over the blocks of the scene in their order, on all cores.

enum class Copied { all, too_wide_for_int16 };

/// Reads the posts of all blocks that are not finished from the sources and writes them. Stops where a height
/// does not fit int16. \param sea  is shown all blocks; null where it wants none
Result<Copied> copy_posts(const Mosaic& mosaic, lod::HeightType type, lod::DraftPosts& posts,
                          SeaClassifier* sea, const Stage& stage);

/// Writes the scene's own posts, with their classes; gives the mesh's fill what was written.
Result<void> finish_posts(const lod::DraftPosts& cleaned, const geo::GridFrame& frame,
                          const SeaClassifier& sea, lod::DraftPosts& posts, lod::MeshHeights& fill,
                          const Stage& stage);

void list_outliers(const Outliers& outliers, lod::SceneInfo& info);

/// Builds the metrics of finished posts and writes the pyramid over them, and fills in what `info` says of
/// these; of outliers only where `count_outliers`: else they were found before they were replaced.
Result<void> measure_posts(const lod::DraftPosts& posts, const lod::MeshHeights& fill,
                           const lod::UndulationGrid& undulations, const lod::SceneWriter& writer,
                           bool count_outliers, lod::SceneInfo& info, const Stage& stage);

}  // namespace relevo::ingest
