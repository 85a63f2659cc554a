#pragma once

#include <glm/vec2.hpp>

#include "lod/ocean/wave_map.hpp"
#include "viewer/gl/gl_object.hpp"

namespace relevo::viewer {

/// A wave map in the memory of what draws it, for shaders/wave_map.glsl: its levels as those of one texture,
/// and where its copies lie. 4 bytes a coefficient: 5.3 MiB at most.
class WaveMapTexture {
  public:
    explicit WaveMapTexture(const lod::WaveMap& map);

    /// For pictures from over a place of the chart, at a time: in double here, so that copies are where they
    /// belong after hours and far from the anchor.
    void update(const lod::WaveMap& map, const glm::dvec2& nadir, double time_s);
    void bind() const;

  private:
    GlTexture levels_;
    GlBuffer block_;
};

}  // namespace relevo::viewer
