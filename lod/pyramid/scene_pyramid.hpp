#pragma once

#include <cstdint>
#include <memory>

#include "geo/result.hpp"
#include "lod/pyramid/pyramid.hpp"
#include "lod/scene/scene.hpp"

namespace relevo::lod {

/// The pyramid of a scene on disk. Of levels from 1 on a block's own files are read; at level 0 what follows
/// from the heights is computed at each call: errors and radii of its vertices, which are those of the last
/// two levels of the hierarchy, and normals.
///
/// Any block of the padded grid may be asked for. One in whose diamonds there is no valid post has heights of
/// 0 in place of filled ones, and codes of 0: nothing of it is ever drawn.
class ScenePyramid final : public Pyramid {
  public:
    static constexpr std::uint64_t kUsualCache = std::uint64_t{64} << 20;

    /// A grid of a single block (top() == 0) is read as a whole here.
    /// \param cache_bytes  for blocks of heights that were read lately: one of level 0 needs parts of several
    static Result<ScenePyramid> open(Scene scene, std::uint64_t cache_bytes = kUsualCache);
    ScenePyramid(ScenePyramid&&) noexcept;
    ScenePyramid& operator=(ScenePyramid&&) noexcept;
    ~ScenePyramid() override;

    const geo::GridFrame& frame() const override;
    /// Where the scene has no bounded errors, the incremental ones stand in for them.
    Result<VertexPosts> read_vertices(const PyramidBlock& block, ErrorMetric metric) const override;
    Result<GroundPosts> read_ground(const PyramidBlock& block) const override;
    Result<BlockHeights> read_heights(const PyramidBlock& block) const override;

  private:
    struct State;
    explicit ScenePyramid(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace relevo::lod
