#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/import.hpp"
#include "ingest/job.hpp"
#include "ingest/memory_budget.hpp"
#include "ingest/mosaic/mosaic.hpp"
#include "ingest/progress.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/scene/scene_writer.hpp"

namespace relevo::ingest {

/// One import: from the posts of a mosaic's sources to a scene in its place. Drafts of the posts, despiked
/// and filled as asked; then with classes, as the scene stores them; errors and radii of those; and what is
/// said of it all.
class SceneImport {
  public:
    /// \pre all outlive this
    /// \param files  of the sources, as they were when the mosaic was opened
    SceneImport(const Mosaic& mosaic, const ImportOptions& options, lod::HeightType type,
                const std::vector<FileState>& files);

    enum class Outcome {
        done,
        too_wide_for_int16,  ///< to be begun again with floats: whole numbers that do not fit were read
        all_void
    };

    /// All steps in their order; after `done` the scene is in its place.
    /// \param plan  whose notes grow
    Result<Outcome> run(lod::SceneWriter& writer, ImportPlan& plan, const Progress& progress);

  private:
    std::uint64_t cache_of_a_draft() const;
    Result<Outcome> make_posts(const lod::SceneWriter& writer, lod::DraftPosts& posts, lod::MeshHeights& fill,
                               const Stage& stage);
    Result<void> compare_with_sources(const lod::DraftPosts& posts, const Stage& stage);
    void write_notes(ImportPlan& plan);
    Result<void> check_archives() const;
    Result<void> add_checksums();

    const Mosaic& mosaic_;
    const ImportOptions& options_;
    const std::vector<FileState>& files_;
    MemoryBudget memory_;
    lod::SceneInfo info_;
};

}  // namespace relevo::ingest
