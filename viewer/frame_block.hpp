#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "lod/terrain.hpp"
#include "lod/view.hpp"
#include "viewer/haze.hpp"
#include "viewer/sun_setting.hpp"

namespace relevo::viewer {

/// The uniform block of shaders/frame.glsl (std140: every member is a multiple of 16 bytes).
struct FrameBlock {
    glm::mat4 clip_from_offset;
    glm::vec4 eye_up;
    glm::vec4 grid;
    glm::vec4 place;
    glm::vec4 sun;
    glm::vec4 surface;
    glm::vec4 ray;
    glm::vec4 ray_right;
    glm::vec4 ray_up;
    glm::vec4 eye_scaled;
    glm::vec4 base_axes;
    glm::vec4 sun_at_eye;
};
static_assert(sizeof(FrameBlock) == 64 + 11 * 16);

/// The part of the whole picture that is drawn, in pixels from its upper left corner.
struct Window {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// \param base_m  height of the base surface, where there is no data, above the ellipsoid
/// \param may_be_below  is the eye below the ground, as far as is known?
FrameBlock frame_block(const lod::View& view, const lod::Terrain& terrain, const Window& window,
                       const SunSetting& sun, const Haze& haze, double exaggeration, double base_m,
                       bool may_be_below);

}  // namespace relevo::viewer
