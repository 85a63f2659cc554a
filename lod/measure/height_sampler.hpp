#pragma once

#include <list>
#include <optional>
#include <unordered_map>

#include "geo/frame.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::lod {

/// The one way to read a height between posts, for every measuring tool: bilinear in grid coordinates over the full
/// data, and exactly the post within 1e-6 of one. A cell with a void corner is void. Keeps the blocks read last.
class HeightSampler {
  public:
    static constexpr double kPostTolerance = 1e-6;

    /// The scene must outlive the sampler.
    explicit HeightSampler(const Scene& scene) : scene_(scene) {}

    const Scene& scene() const { return scene_; }

    /// H of a post, metres; nothing for a void. \pre inside the data
    Result<std::optional<double>> post(int column, int row);

    /// H at a place, metres; nothing for a void or outside.
    Result<std::optional<double>> height(geo::GridPosition place);

    /// Is the place within the data's rectangle?
    bool inside(geo::GridPosition place) const;

  private:
    static constexpr std::size_t kMaxBlocks = 64;  // 64 MiB of heights

    struct CachedBlock {
        Raster<float> heights;
        std::list<std::uint64_t>::iterator age;
    };

    const Scene& scene_;
    std::unordered_map<std::uint64_t, CachedBlock> blocks_;
    std::list<std::uint64_t> ages_;  // newest first
};

}  // namespace relevo::lod
