#pragma once

#include <filesystem>
#include <memory>

#include "geo/result.hpp"
#include "lod/scene/raster.hpp"
#include "lod/scene/scene_info.hpp"
#include "lod/undulation_grid.hpp"

namespace relevo::lod {

/// Writes a scene beside its place and puts it there in one step when it is whole; destroyed before that, it
/// leaves nothing behind. Only one writer a scene at a time.
class SceneWriter {
  public:
    /// Fails where the place is taken (unless overwrite; only a scene is ever overwritten), locked by another
    /// writer, or cannot be written.
    static Result<SceneWriter> create(const std::filesystem::path& path, bool overwrite);
    SceneWriter(SceneWriter&&) noexcept;
    SceneWriter& operator=(SceneWriter&&) noexcept;
    ~SceneWriter();

    /// Heights H of the whole data, metres, void = NaN; stored as `type`, which must hold them exactly.
    Result<void> write_heights(const Raster<float>& heights, HeightType type, const geo::GridFrame& frame);

    /// Metric codes of the padded grid. Blocks of nothing but zeros cost no disk.
    Result<void> write_metrics(const MetricRasters& metrics);

    Result<void> write_undulations(const UndulationGrid& undulations);

    /// Writes scene.json (block lists are filled in here), syncs everything to disk, and puts the scene in
    /// its place.
    Result<void> commit(SceneInfo info);

  private:
    struct State;
    explicit SceneWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace relevo::lod
