#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "geo/geoid_nodes.hpp"
#include "geo/result.hpp"
#include "lod/scene/draft_posts.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/scene/scene_place.hpp"

namespace relevo::lod {

/// Writes a scene beside its place, block by block, and puts it there in one step when it is whole; destroyed
/// before that, it leaves nothing behind unless it was told to keep what it has. Only one writer a scene at a
/// time.
class SceneWriter {
  public:
    /// Fails where the place is taken (unless the claim says overwrite; only a scene is ever overwritten),
    /// locked by another writer, or cannot be written.
    static Result<SceneWriter> create(const std::filesystem::path& path, const SceneClaim& claim);
    SceneWriter(SceneWriter&&) noexcept;
    SceneWriter& operator=(SceneWriter&&) noexcept;
    ~SceneWriter();

    /// Does it go on from what an earlier writer has left?
    bool resumed() const;

    /// Is any block finished?
    bool has_blocks() const;

    /// From here on, what is finished stays on disk for a writer that resumes, if this one ends early.
    void keep_for_resume();

    /// The heights and marks of the scene.
    Result<DraftPosts> posts(const geo::GridFrame& frame, const HeightCoding& coding,
                             std::uint64_t cache_bytes) const;
    /// Those of a step on the way to them. \param name  of its folders; the writer deletes them at last
    Result<DraftPosts> draft(const std::string& name, const geo::GridFrame& frame, const HeightCoding& coding,
                             std::uint64_t cache_bytes) const;
    /// Another layer: of a level of the pyramid (level_folder).
    Result<BlockStore> layer(const std::string& name) const;

    /// The geoid around the scene; none for heights above the ellipsoid.
    Result<void> write_geoid(const geo::GeoidNodes& nodes);

    /// Writes scene.json (block lists are filled in here, from the layers' journals), syncs everything to
    /// disk, and puts the scene in its place.
    Result<void> commit(SceneInfo info);

  private:
    struct State;
    explicit SceneWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace relevo::lod
